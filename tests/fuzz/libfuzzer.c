/* SPDX-License-Identifier: GPL-3.0-or-later */
/* libFuzzer's way into a target. */
#include "fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    (void)fuzz_read(bytes, size);
    return 0;
}
