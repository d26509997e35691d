/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * tecstat: one number per variable of a zone of a Tecplot file or table, for scripts and tests.
 *
 * The command line becomes a request; the rows that --where leaves are listed; a row of the table
 * `commands` then prints the numbers. See the text of usage().
 */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "swing.h"
#include "tecplot_find.h"
#include "tecplot_rough.h"

enum exit_status { DONE = 0, NO_ROWS = 1, TROUBLE = 2 };

/* Rows whose initial coordinate is this part of the range from an end belong to that end. */
static const double end_tolerance = 1e-6;

struct condition {
    const char *variable;
    double low;
    double high;
};

struct request {
    const char *path;
    const char *zone; /* "last", "first" or a number from 1 */
    struct condition *conditions;
    size_t condition_count;
    const char **words; /* WHAT and what follows it */
    size_t word_count;
    bool help;
};

/* The zone and its rows that are left. */
struct selection {
    const struct tecplot_file *file;
    const struct tecplot_zone *zone;
    size_t *rows;
    size_t row_count;
};

static bool complain(const char *what, const char *text)
{
    fprintf(stderr, "tecstat: error: %s '%s'\n", what, text);
    return false;
}

static bool complain_memory(void)
{
    fputs("tecstat: error: out of memory\n", stderr);
    return false;
}

/* ---- command line ---- */

static bool read_where(char **operands, struct request *request)
{
    struct condition condition = {.variable = operands[0]};
    const char *low = operands[1];
    const char *high = operands[2];
    if (tecplot_number(low, strlen(low), &condition.low) != NULL || isnan(condition.low))
        return complain("--where VAR LO HI: LO is not a number:", low);
    if (tecplot_number(high, strlen(high), &condition.high) != NULL || isnan(condition.high))
        return complain("--where VAR LO HI: HI is not a number:", high);
    request->conditions[request->condition_count++] = condition;
    return true;
}

/* Reads the option at arguments[*index] and moves *index to its last operand. */
static bool read_option(int argument_count, char **arguments, int *index, struct request *request)
{
    const char *option = arguments[*index];
    const int operand_count = argument_count - *index - 1;
    if (strcmp(option, "--help") == 0 || strcmp(option, "-h") == 0) {
        request->help = true;
        return true;
    }
    if (strcmp(option, "--zone") == 0) {
        if (operand_count < 1)
            return complain("last, first or a number is missing after", option);
        request->zone = arguments[*index + 1];
        *index += 1;
        return true;
    }
    if (strcmp(option, "--where") != 0)
        return complain("unknown option", option);
    if (operand_count < 3)
        return complain("VAR LO HI are missing after", option);
    *index += 3;
    return read_where(&arguments[*index - 2], request);
}

static bool read_command_line(int argument_count, char **arguments, struct request *request)
{
    bool options_ended = false;
    for (int i = 1; i < argument_count; ++i) {
        const char *argument = arguments[i];
        if (!options_ended && strcmp(argument, "--") == 0)
            options_ended = true;
        else if (!options_ended && argument[0] == '-' && argument[1] != '\0') {
            if (!read_option(argument_count, arguments, &i, request))
                return false;
        } else if (request->path == NULL)
            request->path = argument;
        else
            request->words[request->word_count++] = argument;
    }
    return true;
}

/* Room for as many words and conditions as there are arguments. */
static bool open_request(int argument_count, struct request *request)
{
    const size_t count = argument_count > 0 ? (size_t)argument_count : 1;
    *request = (struct request){.zone = "last"};
    request->words = calloc(count, sizeof *request->words);
    request->conditions = calloc(count, sizeof *request->conditions);
    return (request->words != NULL && request->conditions != NULL) || complain_memory();
}

static void close_request(struct request *request)
{
    free(request->words);
    free(request->conditions);
}

/* ---- variables ---- */

static double value_at(const struct selection *selection, size_t index, size_t column)
{
    return selection->zone
        ->values[selection->rows[index] * selection->file->variable_count + column];
}

/* The values of one variable in the rows left; NULL (after a message) when there is no memory. */
static double *values_of(const struct selection *selection, size_t column)
{
    double *values = calloc(selection->row_count, sizeof *values);
    if (values == NULL)
        (void)complain_memory();
    else
        for (size_t i = 0; i < selection->row_count; ++i)
            values[i] = value_at(selection, i, column);
    return values;
}

/* ---- selection ---- */

/* Drops the rows that do not meet the condition. A NaN meets none. */
static bool restrict_rows(struct selection *selection, const struct condition *condition)
{
    size_t column = 0;
    size_t kept = 0;
    if (!tecplot_find_column("tecstat", selection->file, condition->variable, &column))
        return false;
    for (size_t i = 0; i < selection->row_count; ++i) {
        const double value = value_at(selection, i, column);
        if (value >= condition->low && value <= condition->high)
            selection->rows[kept++] = selection->rows[i];
    }
    selection->row_count = kept;
    return true;
}

static bool select_rows(const struct request *request, struct selection *selection)
{
    if (!tecplot_find_zone("tecstat", selection->file, request->zone, &selection->zone))
        return false;
    const size_t count = selection->zone->row_count;
    selection->rows = calloc(count > 0 ? count : 1, sizeof *selection->rows);
    if (selection->rows == NULL)
        return complain_memory();
    for (size_t i = 0; i < count; ++i)
        selection->rows[i] = i;
    selection->row_count = count;
    for (size_t i = 0; i < request->condition_count; ++i)
        if (!restrict_rows(selection, &request->conditions[i]))
            return false;
    return true;
}

/* ---- statistics of one column; count >= 1, a NaN among the values gives NaN ---- */

static double minimum(const double *values, size_t count)
{
    double result = values[0];
    for (size_t i = 0; i < count && !isnan(result); ++i)
        if (isnan(values[i]) || values[i] < result)
            result = values[i];
    return result;
}

static double maximum(const double *values, size_t count)
{
    double result = values[0];
    for (size_t i = 0; i < count && !isnan(result); ++i)
        if (isnan(values[i]) || values[i] > result)
            result = values[i];
    return result;
}

static double sum(const double *values, size_t count)
{
    long double result = 0.0L;
    for (size_t i = 0; i < count; ++i)
        result += values[i];
    return (double)result;
}

static double mean(const double *values, size_t count)
{
    return sum(values, count) / (double)count;
}

static double range(const double *values, size_t count)
{
    return maximum(values, count) - minimum(values, count);
}

static double row_count(const double *values, size_t count)
{
    (void)values;
    return (double)count;
}

static double first_value(const double *values, size_t count)
{
    (void)count;
    return values[0];
}

static double last_value(const double *values, size_t count)
{
    return values[count - 1];
}

static double largest_size(const double *values, size_t count)
{
    return fmax(fabs(minimum(values, count)), fabs(maximum(values, count)));
}

static double root_mean_square(const double *values, size_t count)
{
    long double result = 0.0L;
    for (size_t i = 0; i < count; ++i)
        result += (long double)values[i] * values[i];
    return (double)sqrtl(result / (long double)count);
}

static const struct statistic {
    const char *name;
    double (*of)(const double *values, size_t count);
    const char *explanation;
} statistics[] = {
    {"min", minimum, "smallest value"},
    {"max", maximum, "largest value"},
    {"mean", mean, "sum / count"},
    {"range", range, "max - min"},
    {"count", row_count, "number of rows (the variable may be left out)"},
    {"first", first_value, "value in the first row"},
    {"last", last_value, "value in the last row"},
    {"absmax", largest_size, "largest |value|"},
    {"rms", root_mean_square, "square root of the mean square"},
    {"sum", sum, "sum of the values"},
};

static const struct statistic *find_statistic(const char *name)
{
    for (size_t i = 0; i < sizeof statistics / sizeof *statistics; ++i)
        if (strcmp(name, statistics[i].name) == 0)
            return &statistics[i];
    return NULL;
}

/* ---- strain ---- */

/* The mean of the displacements whose initial coordinate lies at `end` of the range. */
static double mean_at_end(const double *displacement, const double *initial, size_t count,
                          double end, double length)
{
    long double total = 0.0L;
    size_t found = 0;
    for (size_t i = 0; i < count; ++i)
        if (fabs(initial[i] - end) <= end_tolerance * length) {
            total += displacement[i];
            ++found;
        }
    return found > 0 ? (double)(total / (long double)found) : (double)NAN;
}

/* Mean displacement at the far end minus that at the near end, over the initial length. */
static double strain_of(const double *displacement, const double *initial, size_t count)
{
    const double near_end = minimum(initial, count);
    const double far_end = maximum(initial, count);
    const double length = far_end - near_end;
    const double near_mean = mean_at_end(displacement, initial, count, near_end, length);
    const double far_mean = mean_at_end(displacement, initial, count, far_end, length);
    return (far_mean - near_mean) / length;
}

/* ---- statistics of two columns ---- */

/* Slope of the straight line of least squares. */
static double slope_of(const double *values, const double *over, size_t count)
{
    const double value_mean = mean(values, count);
    const double over_mean = mean(over, count);
    long double products = 0.0L;
    long double squares = 0.0L;
    for (size_t i = 0; i < count; ++i) {
        const long double distance = over[i] - over_mean;
        products += distance * (values[i] - value_mean);
        squares += distance * distance;
    }
    return (double)(products / squares);
}

static bool differs(const double *over, size_t count)
{
    return range(over, count) != 0.0;
}

static const struct pair_statistic {
    const char *name;
    double (*of)(const double *values, const double *over, size_t count);
    bool (*is_fit)(const double *over, size_t count);
    const char *unfit; /* said where the second variable is not fit for it */
    bool is_initial;   /* the second variable is less the first one: coordinates at the start */
} pair_statistics[] = {
    {"strain", strain_of, differs, "all rows have the same initial coordinate", true},
    {"slope", slope_of, differs, "all rows have the same value of the second variable", false},
    {"period", swing_period, swing_has_time, "needs 8 rows or more whose times grow", false},
    {"decay", swing_decay, swing_has_time, "needs 8 rows or more whose times grow", false},
};

static const struct pair_statistic *find_pair_statistic(const char *name)
{
    for (size_t i = 0; i < sizeof pair_statistics / sizeof *pair_statistics; ++i)
        if (strcmp(name, pair_statistics[i].name) == 0)
            return &pair_statistics[i];
    return NULL;
}

/* ---- output ---- */

static void print_number(double number)
{
    if (isnan(number))
        puts("nan");
    else
        printf("%.12g\n", number == 0.0 ? 0.0 : number);
}

static bool print_statistic(const struct selection *selection, const struct statistic *statistic,
                            size_t column)
{
    double *values = values_of(selection, column);
    if (values == NULL)
        return false;
    print_number(statistic->of(values, selection->row_count));
    free(values);
    return true;
}

static bool print_pair_statistic(const struct selection *selection,
                                 const struct pair_statistic *statistic, const size_t *columns)
{
    const size_t count = selection->row_count;
    double *values = values_of(selection, columns[0]);
    double *over = values_of(selection, columns[1]);
    bool done = values != NULL && over != NULL;
    if (done) {
        for (size_t i = 0; i < count && statistic->is_initial; ++i)
            over[i] -= values[i];
        done = statistic->is_fit(over, count);
        if (done)
            print_number(statistic->of(values, over, count));
        else
            fprintf(stderr, "tecstat: error: %s: %s\n", statistic->name, statistic->unfit);
    }
    free(over);
    free(values);
    return done;
}

/* The last three columns are the coordinates. */
static bool print_roughness(const struct selection *selection, double reach, const size_t *columns,
                            size_t column_count)
{
    double *places[3];
    bool done = true;
    for (int i = 0; i < 3; ++i) {
        places[i] = values_of(selection, columns[column_count + (size_t)i]);
        done = done && places[i] != NULL;
    }
    for (size_t i = 0; i < column_count && done; ++i) {
        double *values = values_of(selection, columns[i]);
        done = values != NULL;
        if (done)
            print_number(tecplot_roughness((const double *const[]){places[0], places[1], places[2]}, values,
                                           selection->row_count, reach));
        free(values);
    }
    for (int i = 0; i < 3; ++i)
        free(places[i]);
    return done;
}

static bool print_row(const struct selection *selection, size_t number, const size_t *columns,
                      size_t column_count)
{
    if (number > selection->row_count) {
        fprintf(stderr, "tecstat: error: no row %zu, there are %zu\n", number,
                selection->row_count);
        return false;
    }
    for (size_t i = 0; i < column_count; ++i)
        print_number(value_at(selection, number - 1, columns[i]));
    return true;
}

/* ---- commands ---- */

/* What is to be printed: WHAT and the columns of its variables. */
struct command {
    const struct statistic *statistic;   /* or NULL */
    const struct pair_statistic *of_two; /* or NULL */
    double reach;                        /* of the command rough, 0 for others */
    size_t row;                          /* of the command row, which is none of these */
    const char **names;                  /* variables, in the request */
    size_t name_count;
    size_t *columns; /* likewise */
};

static bool read_row_command(const struct request *request, struct command *command)
{
    if (request->word_count < 3)
        return complain("a row number and a variable are needed after", "row");
    if (!tecplot_find_ordinal(request->words[1], &command->row))
        return complain("row N VARIABLE...: N must be a number from 1, not", request->words[1]);
    command->names += 1;
    command->name_count -= 1;
    return true;
}

static bool read_rough_command(const struct request *request, struct command *command)
{
    const char *reach = request->word_count > 1 ? request->words[1] : "";
    if (request->word_count < 3)
        return complain("a distance and a variable are needed after", "rough");
    if (tecplot_number(reach, strlen(reach), &command->reach) != NULL || !(command->reach > 0.0))
        return complain("rough REACH VARIABLE...: REACH must be a number above 0, not", reach);
    command->names += 1;
    command->name_count -= 1;
    return true;
}

static bool read_command(const struct request *request, struct command *command)
{
    const char *what = request->words[0];
    *command = (struct command){.names = request->words + 1, .name_count = request->word_count - 1};
    if (strcmp(what, "row") == 0)
        return read_row_command(request, command);
    if (strcmp(what, "rough") == 0)
        return read_rough_command(request, command);
    command->of_two = find_pair_statistic(what);
    if (command->of_two != NULL)
        return command->name_count == 2 || complain("two variables are needed after", what);
    command->statistic = find_statistic(what);
    if (command->statistic == NULL)
        return complain("unknown statistic (tecstat --help lists them):", what);
    return command->name_count > 0 || command->statistic->of == row_count ||
           complain("a variable is needed after", what);
}

static bool find_columns(const struct tecplot_file *file, struct command *command)
{
    static const char *const coordinates[] = {"X", "Y", "Z"};
    command->columns = calloc(command->name_count + 3, sizeof *command->columns);
    if (command->columns == NULL)
        return complain_memory();
    for (size_t i = 0; i < command->name_count; ++i)
        if (!tecplot_find_column("tecstat", file, command->names[i], &command->columns[i]))
            return false;
    for (size_t i = 0; i < 3 && command->reach > 0.0; ++i)
        if (!tecplot_find_column("tecstat", file, coordinates[i], &command->columns[command->name_count + i]))
            return false;
    if (command->name_count == 0)
        command->name_count = 1; /* count of the first column, the same in all */
    return true;
}

static bool print_command(const struct selection *selection, const struct command *command)
{
    if (command->of_two != NULL)
        return print_pair_statistic(selection, command->of_two, command->columns);
    if (command->reach > 0.0)
        return print_roughness(selection, command->reach, command->columns, command->name_count);
    if (command->statistic == NULL)
        return print_row(selection, command->row, command->columns, command->name_count);
    for (size_t i = 0; i < command->name_count; ++i)
        if (!print_statistic(selection, command->statistic, command->columns[i]))
            return false;
    return true;
}

static enum exit_status report_no_rows(const struct selection *selection,
                                       const struct command *command)
{
    if (command->statistic != NULL && command->statistic->of == row_count)
        for (size_t i = 0; i < command->name_count; ++i)
            print_number(0.0);
    fprintf(stderr, "tecstat: error: no rows are left of %zu\n", selection->zone->row_count);
    return NO_ROWS;
}

/* ---- main ---- */

static void usage(FILE *stream)
{
    fputs("usage: tecstat FILE [--zone last|first|N] [--where VAR LO HI]... WHAT VARIABLE...\n"
          "\n"
          "Prints one number per variable and line, from one zone of a Tecplot file or table.\n"
          "\n"
          "  --zone last|first|N  the zone, counted from 1 (last)\n"
          "  --where VAR LO HI    only rows with LO <= VAR <= HI; may be repeated\n"
          "\n"
          "WHAT is\n",
          stream);
    for (size_t i = 0; i < sizeof statistics / sizeof *statistics; ++i)
        fprintf(stream, "  %-12s %s\n", statistics[i].name, statistics[i].explanation);
    fputs("  row N        values in row N of the rows left, counted from 1\n"
          "  strain       takes DISP COORD: (mean DISP over the rows with the largest COORD-DISP\n"
          "               - mean DISP over those with the smallest) / (largest - smallest);\n"
          "               rows within 1e-6 of the range from an end belong to that end\n"
          "  slope        takes VAR OVER: that of the straight line of least squares\n"
          "  period       takes VAR TIME: of the strongest swing that fits 2 to 200 times into\n"
          "               the time of the rows: largest component of Fourier under a Hann window\n"
          "  decay        takes VAR TIME: rate b of exp(-b t), from the size of that swing in the\n"
          "               first and in the second half of the time\n"
          "  rough REACH  root mean square of the variable less the plane over X, Y, Z that fits the\n"
          "               rows within REACH of each one best\n"
          "\n"
          "Upper and lower case of variable names need not agree. A NaN among the values gives\n"
          "nan; --where drops rows in which VAR is NaN. A file \"-\" is standard input.\n"
          "\n"
          "exit status: 0 done, 1 no rows are left, 2 wrong usage or a file that is unreadable,\n"
          "damaged or cut\n"
          "\n"
          "example: tecstat bar_anim.dat --zone 3 --where mat 1 1 max pres seqv\n",
          stream);
}

static enum exit_status evaluate(const struct request *request, struct command *command,
                                 const struct tecplot_file *file)
{
    struct selection selection = {.file = file};
    enum exit_status status = TROUBLE;
    if (find_columns(file, command) && select_rows(request, &selection)) {
        if (selection.row_count == 0)
            status = report_no_rows(&selection, command);
        else if (print_command(&selection, command))
            status = DONE;
    }
    free(selection.rows);
    free(command->columns);
    return status;
}

static enum exit_status run(const struct request *request)
{
    struct command command;
    struct tecplot_file file;
    struct tecplot_error error;
    if (request->path == NULL || request->word_count == 0) {
        fputs("tecstat: error: FILE and WHAT are needed\n", stderr);
        usage(stderr);
        return TROUBLE;
    }
    if (!read_command(request, &command))
        return TROUBLE;
    if (!tecplot_read(request->path, &file, &error)) {
        tecplot_print_error(request->path, &error);
        return TROUBLE;
    }
    const enum exit_status status = evaluate(request, &command, &file);
    tecplot_free(&file);
    return status;
}

int main(int argument_count, char **arguments)
{
    struct request request;
    enum exit_status status = TROUBLE;
    if (open_request(argument_count, &request) &&
        read_command_line(argument_count, arguments, &request)) {
        status = request.help ? DONE : run(&request);
        if (request.help)
            usage(stdout);
    }
    close_request(&request);
    if (fflush(stdout) != 0 || ferror(stdout)) {
        fputs("tecstat: error: the result cannot be written\n", stderr);
        return TROUBLE;
    }
    return (int)status;
}
