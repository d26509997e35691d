/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Spellings of numbers (spec 1.4), words and their places (spec 1.2), keywords (spec 1.3). The
 * expected values are the same numbers in C's spelling. */
#include "base/memory.h"
#include "check.h"
#include "deck/number.h"
#include "scene_text.h"

#include <stdlib.h>
#include <string.h>

/* --- numbers --- */

struct number {
    const char *text;
    bool is_real, is_integer;
    double value;
};

static const struct number numbers[] = {
    /* whole numbers */
    {"1", true, true, 1}, {"0", true, true, 0}, {"-0", true, true, 0}, {"+1", true, true, 1}, {"-7", true, true, -7},
    {"007", true, true, 7}, {"2147483647", true, true, 2147483647}, {"9000000000000000", true, true, 9e15},
    {"-9000000000000000", true, true, -9e15}, {"9000000000000002", true, false, 9000000000000002.0},
    {"99999999999999999999", true, false, 1e20},
    /* a point or an exponent makes a number real */
    {"1.", true, false, 1}, {"1.0", true, false, 1}, {"32.0", true, false, 32}, {".5", true, false, 0.5},
    {"+.5", true, false, 0.5}, {"-.5", true, false, -0.5}, {"-2.", true, false, -2}, {"1e5", true, false, 1e5},
    {"1E5", true, false, 1e5}, {"1e0", true, false, 1}, {"0e0", true, false, 0}, {"-2.5e3", true, false, -2500},
    {"1.0d-3", true, false, 1e-3}, {"1.0D-3", true, false, 1e-3}, {"1d3", true, false, 1000},
    {"1D+03", true, false, 1000}, {".5d1", true, false, 5}, {"1.d0", true, false, 1},
    {"4.9e-004", true, false, 4.9e-4}, {"1.5-3", true, false, 1.5e-3}, {"1.5+3", true, false, 1.5e3},
    {"1-3", true, false, 1e-3}, {"-1-3", true, false, -1e-3}, {"1+0", true, false, 1}, {".5-1", true, false, 0.05},
    {"1e+5", true, false, 1e5}, {"1e00000000000000000005", true, false, 1e5}, {"1e-400", true, false, 0},
    {"1e400", true, false, INFINITY}, {"-1e400", true, false, -INFINITY},
    {"0.1", true, false, 0.1}, {"0.33333333333333333333333333333333333", true, false, 1.0 / 3},
    {"2.2250738585072014e-308", true, false, 2.2250738585072014e-308},
    {"8.96e-3", true, false, 8.96e-3}, {"120.0e3", true, false, 120e3},
    /* no numbers */
    {"", false, false, 0}, {".", false, false, 0}, {"-", false, false, 0}, {"+", false, false, 0},
    {"-.", false, false, 0}, {"e5", false, false, 0}, {".e5", false, false, 0}, {"d3", false, false, 0},
    {"-e5", false, false, 0}, {"1e", false, false, 0}, {"1e+", false, false, 0}, {"1e-", false, false, 0},
    {"1d", false, false, 0}, {"1+", false, false, 0}, {"1.5-", false, false, 0}, {"0.5abc", false, false, 0},
    {"5abc", false, false, 0}, {"1e5x", false, false, 0}, {"1e5.", false, false, 0}, {"1e5.0", false, false, 0},
    {"1e5e5", false, false, 0}, {"1e5-3", false, false, 0}, {"1..2", false, false, 0}, {"1.2.3", false, false, 0},
    {"--5", false, false, 0}, {"+-5", false, false, 0}, {"-+5", false, false, 0}, {"0x10", false, false, 0},
    {"1f5", false, false, 0}, {"1q5", false, false, 0}, {"1ee5", false, false, 0}, {"1ed5", false, false, 0},
    {"1e--5", false, false, 0}, {"inf", false, false, 0}, {"nan", false, false, 0}, {"infinity", false, false, 0},
    {"-inf", false, false, 0}, {"1_000", false, false, 0}, {"1'000", false, false, 0}, {"1/2", false, false, 0},
    {"5%", false, false, 0}, {"\"1\"", false, false, 0}, {"one", false, false, 0}, {"1 ", false, false, 0},
    {" 1", false, false, 0}, {"1e 5", false, false, 0}, {"\xB2", false, false, 0}, {"1\xC2\xB2", false, false, 0},
};

/* Reads the text as a word that something else follows directly. */
static void check_number(const char *text, size_t length, const struct number *expected, const char *name)
{
    char *room = malloc(length + 2);
    double real = 0;
    long integer = 0;
    if (!room)
        exit(1);
    memcpy(room, text, length);
    memcpy(room + length, "9", 2);
    struct deck_word word = {.text = room, .length = length};
    bool is_real = number_is_real(&word, &real), is_integer = number_is_integer(&word, &integer);
    bool good = is_real == expected->is_real && is_integer == expected->is_integer
             && (!is_real || real == expected->value) && (!is_integer || (double)integer == expected->value);
    check_true(name, good);
    free(room);
}

static void test_numbers(void)
{
    char name[80];
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        snprintf(name, sizeof name, "number: '%s'", numbers[i].text);
        check_number(numbers[i].text, strlen(numbers[i].text), &numbers[i], name);
    }
}

/* Thousands of digits: zeros before a number change nothing, digits behind it little. */
static void test_long_numbers(void)
{
    enum { DIGITS = 5000 };
    static char text[DIGITS + 10];
    memset(text, '0', DIGITS);
    memcpy(text + DIGITS, "42", 2);
    check_number(text, DIGITS + 2, &(struct number){"", true, true, 42}, "number: zeros, then 42");
    memcpy(text + DIGITS, ".25", 3);
    check_number(text, DIGITS + 3, &(struct number){"", true, false, 0.25}, "number: zeros, then .25");
    memset(text, '3', DIGITS);
    memcpy(text, "0.", 2);
    check_number(text, DIGITS, &(struct number){"", true, false, 1.0 / 3}, "number: a third with many digits");
    memset(text, '9', DIGITS);
    check_number(text, DIGITS, &(struct number){"", true, false, INFINITY}, "number: too many digits");
    memcpy(text + DIGITS, "d-5000", 6);
    check_number(text, DIGITS + 6, &(struct number){"", true, false, 1}, "number: many digits, small exponent");
    text[DIGITS / 2] = 'x';
    check_number(text, DIGITS, &(struct number){"", false, false, 0}, "number: a letter among many digits");
}

/* --- words --- */

/* A text, its words each followed by '|', the line and column of the last one, and the number of
 * mistakes. */
static const struct {
    const char *name, *text, *words;
    long line, column;
    int mistakes;
} streams[] = {
    {"one word", "endi", "endi|", 1, 1, 0},
    {"empty text", "", "", 0, 0, 0},
    {"only blanks and lines", "  \n\t\n \r\n", "", 0, 0, 0},
    {"blanks", "  a  b   c  ", "a|b|c|", 1, 10, 0},
    {"lines", "a b\nc\n\n d", "a|b|c|d|", 4, 2, 0},
    {"tabs", "\ta\tb\t\n\t\tc", "a|b|c|", 2, 3, 0},
    {"CRLF", "a b\r\nc\r\n\r\nd\r\n", "a|b|c|d|", 4, 1, 0},
    {"a lone CR is a blank", "a\rb", "a|b|", 1, 3, 0},
    {"comma", "0,1", "0|1|", 1, 3, 0},
    {"comma with blanks", "0 , 1 ,2, 3", "0|1|2|3|", 1, 11, 0},
    {"comma with tabs", "0\t,\t1", "0|1|", 1, 5, 0},
    {"trailing comma", "0, 1,\n2", "0|1|2|", 2, 1, 0},
    {"trailing comma and comment", "0,! none\n1", "0|1|", 2, 1, 0},
    {"two commas", "0,,1", "0|1|", 1, 4, 1},
    {"two commas apart", "0, ,1", "0|1|", 1, 5, 1},
    {"a run of commas is one mistake", "0,,, ,1", "0|1|", 1, 7, 1},
    {"comma first", ",a", "a|", 1, 2, 1},
    {"comma first, later line", "a\n , b", "a|b|", 2, 4, 1},
    {"comma after an ended line", "a,\n,b", "a|b|", 2, 2, 1},
    {"comment", "a ! b c\nd", "a|d|", 2, 1, 0},
    {"comment at a word", "a!b\nc", "a|c|", 2, 1, 0},
    {"comment only", "! nothing", "", 0, 0, 0},
    {"comment in a comment", "! a ! b\nc", "c|", 2, 1, 0},
    {"comment with commas and quotes", "a ! ,, \"\nb", "a|b|", 2, 1, 0},
    {"# is no comment", "# a", "#|a|", 1, 3, 0},
    {"quoted word", "incl \"a b.mpm\" c", "incl|\"a b.mpm\"|c|", 1, 16, 0},
    {"quoted comma and mark", "\"a,b!c\" d", "\"a,b!c\"|d|", 1, 9, 0},
    {"quote that is not closed on the line", "\"a b\nc", "\"a b|c|", 2, 1, 1},
    {"empty quotes", "\"\" a", "\"\"|a|", 1, 4, 0},
    {"quote inside a word", "a\"b c", "a\"b|c|", 1, 5, 0},
    {"byte order mark", "\xEF\xBB\xBF" "a b", "a|b|", 1, 3, 0},
    {"byte order mark, second line", "\xEF\xBB\xBF" "a b\nc", "a|b|c|", 2, 1, 0},
    {"byte order mark alone", "\xEF\xBB\xBF", "", 0, 0, 0},
    {"form feed and vertical tab", "a\fb\vc", "a|b|c|", 1, 5, 0},
    {"bytes above 127", "\xC3\xA4\xC3\xB6 b", "\xC3\xA4\xC3\xB6|b|", 1, 6, 0},
    {"no line end", "a\nb", "a|b|", 2, 1, 0},
};

/* Takes all words, peeking before every other one; the last word and its place are kept. */
static void take_words(struct deck_text *text, char *words, struct deck_word *last)
{
    struct deck_word word, peeked;
    *words = '\0';
    for (int i = 0; i % 2 == 0 || text_peek(text, &peeked); i++) {
        if (!text_next(text, &word))
            return;
        if (i % 2 == 1 && (peeked.text != word.text || peeked.length != word.length))
            strcat(words, "(peeked another word)");
        strncat(words, word.text, word.length);
        strcat(words, "|");
        *last = word;
    }
}

static void test_words(void)
{
    for (size_t i = 0; i < sizeof streams / sizeof streams[0]; i++) {
        struct diagnostics *diagnostics = diagnostics_open();
        struct deck_text *text = text_open(diagnostics);
        struct deck_word last = {0};
        char words[200], name[80];
        text_include_memory(text, "text", streams[i].text, strlen(streams[i].text));
        take_words(text, words, &last);
        bool good = strcmp(words, streams[i].words) == 0 && last.place.line == streams[i].line
                 && last.place.column == streams[i].column
                 && diagnostics_errors(diagnostics) == streams[i].mistakes;
        if (!good)
            printf("   words %s at %ld:%ld, %d mistakes\n", words, last.place.line, last.place.column,
                   diagnostics_errors(diagnostics));
        snprintf(name, sizeof name, "words: %s", streams[i].name);
        check_true(name, good && !text_peek(text, &last) && !text_next(text, &last));
        text_close(text);
        diagnostics_close(diagnostics);
    }
}

/* A NUL byte is a mistake and ends the text. */
static void test_nul(void)
{
    struct diagnostics *diagnostics = diagnostics_open();
    struct deck_text *text = text_open(diagnostics);
    struct deck_word last = {0};
    char words[200];
    text_include_memory(text, "text", "a\nb\0c d", 7);
    take_words(text, words, &last);
    check_true("words: NUL byte", strcmp(words, "a|b|") == 0 && diagnostics_errors(diagnostics) == 1);
    text_close(text);
    diagnostics_close(diagnostics);
}

/* A line of thousands of words, and words of thousands of letters. */
static void test_long_lines(void)
{
    struct diagnostics *diagnostics = diagnostics_open();
    struct deck_text *text = text_open(diagnostics);
    struct deck_builder deck = {0};
    struct deck_word word;
    long count = 0;
    bool good = true;
    for (int i = 0; i < 3000; i++)
        deck_add(&deck, "w%d%c", i, i % 3 ? ' ' : ',');
    deck_add(&deck, "\n");
    for (int i = 0; i < 3000; i++)
        deck_add(&deck, "letters");
    text_include_memory(text, "text", deck.text, deck.length);
    free(deck.text);
    while (text_next(text, &word)) {
        good = good && (count == 3000 ? word.length == 21000 : atol(word.text + 1) == count);
        count++;
    }
    check_true("words: long lines, long words", good && count == 3001 && diagnostics_errors(diagnostics) == 0);
    text_close(text);
    diagnostics_close(diagnostics);
}

/* An included text is read in place; then the rest of the first one goes on. */
static void test_included(void)
{
    struct diagnostics *diagnostics = diagnostics_open();
    struct deck_text *text = text_open(diagnostics);
    struct deck_word word, last = {0};
    char words[200];
    text_include_memory(text, "outer", "a b\nc", 5);
    text_next(text, &word);
    text_include_memory(text, "inner", "x\n y,", 5);
    take_words(text, words, &last);
    check_true("words: included text", strcmp(words, "x|y|b|c|") == 0 && last.place.file == 0 && last.place.line == 2);
    text_close(text);
    diagnostics_close(diagnostics);
}

static void check_title(const char *name, const char *line, const char *expected)
{
    struct diagnostics *diagnostics = diagnostics_open();
    struct deck_text *text = text_open(diagnostics);
    struct deck_word word;
    text_include_memory(text, "text", line, strlen(line));
    text_next(text, &word);
    char *title = text_rest_of_line(text, &word);
    bool good = strcmp(title, expected) == 0;
    text_next(text, &word);
    good = good && word.length == 4 && memcmp(word.text, "next", 4) == 0;
    check_true(name, good && diagnostics_errors(diagnostics) == 0);
    memory_free(title);
    text_close(text);
    diagnostics_close(diagnostics);
}

static void test_titles(void)
{
    check_title("title: blanks squeezed", "mpm3 \t a   bar,  two \r\nnext", "mpm3 a bar, two");
    check_title("title: comment removed", "mpm3 a bar ! of copper\nnext", "mpm3 a bar");
    check_title("title: only the keyword", "mpm3\nnext", "mpm3");
    check_title("title: quotes and commas", "mpm3 \"a, ,, b\nnext", "mpm3 \"a, ,, b");
}

/* --- keywords --- */

/* The 43 words of spec 2, all known. */
static const char *const spec_words[] = {
    "mpm3", "nbco", "nbbo", "nbmp", "nmat", "endt", "outt", "rptt", "grid", "spx", "spy", "spz", "dcel", "dtsc",
    "fixe", "mate", "seos", "part", "load", "velo", "musl", "usf", "usl", "jaum", "bulk", "gimp", "bimp", "sgmp",
    "TLmp", "UVFp", "smoo", "QuLo", "Damp", "drda", "cont", "deto", "outr", "curv", "curx", "pt2d", "tecp", "para",
    "endi"};

static const struct {
    const char *word, *keyword; /* NULL: unknown */
} spellings[] = {
    {"endt", "endt"}, {"ENDT", "endt"}, {"EndT", "endt"}, {"endtime", "endt"}, {"endtxyz", "endt"}, {"endt!", "endt"},
    {"end", NULL}, {"endx", NULL}, {"en", NULL}, {"", NULL}, {"xendt", NULL}, {"endinput", "endi"}, {"ENDI", "endi"},
    {"fixed", "fixe"}, {"FIXED", "fixe"}, {"fix", NULL}, {"particle", "part"}, {"dcell", "dcel"},
    {"contact", "cont"}, {"MPM3D", "mpm3"}, {"tlmp", "TLmp"}, {"damping", "Damp"}, {"qulo", "QuLo"},
    {"spx", "spx"}, {"SPX", "spx"}, {"Spy", "spy"}, {"spxx", NULL}, {"spx1", NULL}, {"sp", NULL}, {"spxrange", NULL},
    {"usf", "usf"}, {"USF", "usf"}, {"usfx", NULL}, {"usl", "usl"}, {"usld", NULL}, {"us", NULL}, {"musl", "musl"},
    {"musls", "musl"}, {"mus", NULL},
};

static void test_keywords(void)
{
    char name[80];
    bool good = true;
    for (size_t i = 0; i < sizeof spec_words / sizeof spec_words[0]; i++) {
        const struct keyword *row = keyword_find(spec_words[i], NULL);
        good = good && row && strcmp(row->name, spec_words[i]) == 0;
    }
    check_true("keywords: all 43 of the dialect are known", good && sizeof spec_words / sizeof spec_words[0] == 43);
    for (size_t i = 0; i < sizeof spellings / sizeof spellings[0]; i++) {
        const struct keyword *row = keyword_find(spellings[i].word, NULL);
        snprintf(name, sizeof name, "keywords: '%s'", spellings[i].word);
        check_true(name, spellings[i].keyword ? row && strcmp(row->name, spellings[i].keyword) == 0 : !row);
    }
}

/* No row is hidden behind another one with the same four letters, in any table. */
static void test_tables(void)
{
    bool good = true;
    enum category category;
    for (int c = 0; c < CATEGORY_COUNT; c++)
        for (const struct keyword *row = keyword_table((enum category)c); row->name; row++)
            good = good && strlen(row->name) <= 4 && keyword_find(row->name, &category) == row && (int)category == c;
    check_true("keywords: no row hides another", good);
    good = true;
    for (const struct keyword *row = load_keywords; row->name; row++)
        good = good && keyword_in(load_keywords, row->name) == row;
    for (const struct keyword *row = velocity_keywords; row->name; row++)
        good = good && keyword_in(velocity_keywords, row->name) == row;
    check_true("keywords: no row of a block hides another", good);
}

/* Laws, generators and results match by the same rule. */
static void test_names(void)
{
    static const char *const laws[] = {"elas", "pla1", "pla2", "john", "sjc", "sjcf",
                                       "jcf",  "hiex", "null", "dpm",  "neoh"};
    static const char *const generators[] = {"poin", "bloc", "sphe", "blod", "cicl"};
    static const char *const results[] = {"seqv", "epef", "mat", "pres", "volu", "engk", "engi", "velx", "vely", "velz",
                                          "cels", "fail", "sspd", "damg", "stsx", "disx", "disy", "disz"};
    bool good = true;
    for (size_t i = 0; i < sizeof laws / sizeof laws[0]; i++)
        good = good && law_find(laws[i]) && strcmp(law_find(laws[i])->name, laws[i]) == 0;
    check_true("names: laws", good);
    check_true("names: long laws", law_find("ELASTIC") && law_find("ELASTIC") == law_find("elas") && law_find("DPM"));
    check_true("names: no laws", !law_find("dpmx") && !law_find("sjcx") && !law_find("pla") && !law_find("pla3"));
    good = true;
    for (size_t i = 0; i < sizeof generators / sizeof generators[0]; i++)
        good = good && generator_find(generators[i]) && strcmp(generator_find(generators[i])->name, generators[i]) == 0;
    good = good && generator_find("BLOCK") == generator_find("bloc") && !generator_find("blo");
    check_true("names: generators", good);
    good = true;
    for (size_t i = 0; i < sizeof results / sizeof results[0]; i++)
        good = good && result_find(results[i]) && strcmp(result_find(results[i])->name, results[i]) == 0;
    check_true("names: results", good && !result_find("mate") && !result_find("ma") && result_find("PRESSURE"));
}

/* --- numbers and switches in a deck --- */

/* Number of mistakes in a deck that is right but for `line`. */
static int mistakes_of(const char *line)
{
    struct diagnostics *diagnostics = diagnostics_open();
    struct deck_text *text = text_open(diagnostics);
    char deck[400];
    int length = snprintf(deck, sizeof deck, "nbbo 1\nnbmp 1\nnmat 1\ndcell 1\ngrid 0 4 0 4 0 4\nmate\n1 elas 1 1 0.3\n"
                                             "part poin 1 1\n1 1 1 2 2 2\n%s\nendi\n", line);
    text_include_memory(text, "deck", deck, (size_t)length);
    scene_close(reader_read(text, diagnostics));
    int mistakes = diagnostics_errors(diagnostics);
    text_close(text);
    diagnostics_close(diagnostics);
    return mistakes;
}

static void test_decks(void)
{
    static const char *const right[] = {
        "endt 1", "endt .5", "endt +5", "endt 1.5-3", "endt 1d0", "endt\n1", "fixed 0 1 2\n0 1 2", "fixed 0,1,2,0,1,2",
        "usf on", "usf OFF", "usf on usl off", "bulk 1.5,0.06", "jaum on", "jaum Off", "fixed +0 -0 0 0 0 0", "endt 0"};
    static const char *const wrong[] = {
        "endt 0.5abc", "endt abc", "endt", "endt 1e400", "endt nan", "endt -1", "fixed 0 1 2.0 0 0 0",
        "fixed 0 1 1e0 0 0 0", "fixed 0 1 3 0 0 0", "fixed 0 1 2", "usf", "usf yes", "usf onn", "usf o", "jaum offf",
        "usfx on", "spxx 1 2", "bulk 1.5,,0.06", "dtsc 2.6", "dtsc 0", "5", "xyzzy 1"};
    char name[80];
    for (size_t i = 0; i < sizeof right / sizeof right[0]; i++) {
        snprintf(name, sizeof name, "deck: accepted: line %zu", i + 1);
        check_true(name, mistakes_of(right[i]) == 0);
    }
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        snprintf(name, sizeof name, "deck: one mistake: %s", wrong[i]);
        int mistakes = mistakes_of(wrong[i]);
        if (mistakes != 1)
            printf("   %d mistakes\n", mistakes);
        check_true(name, mistakes == 1);
    }
}

int main(void)
{
    test_numbers();
    test_long_numbers();
    test_words();
    test_nul();
    test_long_lines();
    test_included();
    test_titles();
    test_keywords();
    test_tables();
    test_names();
    test_decks();
    return check_result();
}
