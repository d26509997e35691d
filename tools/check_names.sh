#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Every function that is visible outside its file has to begin with a name of its module, so that
# nothing is visible by accident: sh tools/check_names.sh BUILD
cd "$1" || exit 2
prefixes=$(tr " \n" "||" <<END | sed "s/|$//"
main status_ memory_ threads_ timers_ argument_ text_ diagnostics_ keyword_ reader_ scene_
echo_ help_ column_ store_ cell_list_ generator_ solid_ stl_ crossings_ result_ law_ grid_
mpm_ faces_ motion_ stress_ shape_ contact_ smoothing_ eos_ johnson_cook_ vtk_ table_
animation_ history_ progress_ run_ summary_ account_ staggered_ building_ schedule_ transformation_
heat_ laser_ property_ properties_ flow_ surface_ limits_ budget_ sph_ neighbours_ method_
overlap_ light_nodes_ reference_ checkpoint_ checksum_ restart_ vector_ conjugate_ bicgstab_ incomplete_ envelope_ symmetric_ stiffness_ multigrid_ rigid_ equilibrium_
words_ tecplot_ swing_ draw_ tecview_ remove_ bed_
number_ rkpm_ box_ basis_ search_ methods_ field_ quadrature_ cells_ points_ held_ body_ solver_ iteration_ creep_ relaxation_ coarse_ lattice_ deformation_ sparse_ banded_ sound_ maxwell_ finite_
END
)
bad=$(find . -name '*.o' ! -path './tests/*' | while read -r object; do
    nm -g --defined-only "$object" | awk '$2 ~ /[TDBRi]/ { print $3 }' | sed 's/\.resolver$//' | sort -u |
        grep -vE "^($prefixes|[a-z]+_keywords\$)" |
        sed "s|^|$object: |"
done)
[ -z "$bad" ] && echo "all visible names carry their module's prefix" && exit 0
echo "$bad"
exit 1
