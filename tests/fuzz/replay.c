/* SPDX-License-Identifier: BSD-3-Clause */
#include "fuzz.h"

#include <dirent.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Runs a fuzz target without libFuzzer: `replay_x FOLDER RUNS` gives it every file of a corpus, then that many
 * mutations of them, the same ones every time; `replay_x FILE` one file. An input that ends the program is kept as
 * crash-x, for `replay_x crash-x`. */

enum { LARGEST_INPUT = 1 << 16, MOST_FILES = 4096, MOST_CHANGES = 4 };

typedef struct Input {
    size_t size;
    uint8_t *bytes;
} Input;

static Input corpus[MOST_FILES];
static int corpus_count;
static uint8_t mutated[LARGEST_INPUT];
static Input current;

static void keep_current(int signal_number)
{
    char name[64];
    snprintf(name, sizeof name, "crash-%s", fuzz_target.file);
    FILE *file = fopen(name, "wb");
    if (file) {
        fwrite(current.bytes, 1, current.size, file);
        fclose(file);
        fprintf(stderr, "replay: the input is kept as %s\n", name);
    }
    signal(signal_number, SIG_DFL);
    raise(signal_number);
}

static void run(Input input)
{
    current = input;
    LLVMFuzzerTestOneInput(input.bytes, input.size);
}

static Input read_input(const char *path)
{
    FILE *file = fopen(path, "rb");
    Input input = {0, malloc(LARGEST_INPUT)};
    if (!file || !input.bytes) {
        perror(path);
        exit(1);
    }
    input.size = fread(input.bytes, 1, LARGEST_INPUT, file);
    fclose(file);
    return input;
}

static int is_visible(const struct dirent *entry)
{
    return entry->d_name[0] != '.';
}

static void read_corpus(const char *folder)
{
    struct dirent **entry = NULL;
    const int count = scandir(folder, &entry, is_visible, alphasort);
    for (int i = 0; i < count && corpus_count < MOST_FILES; i++) {
        char path[4096];
        snprintf(path, sizeof path, "%s/%s", folder, entry[i]->d_name);
        corpus[corpus_count++] = read_input(path);
        free(entry[i]);
    }
    free(entry);
    if (corpus_count == 0) {
        fprintf(stderr, "replay: no files in %s\n", folder);
        exit(1);
    }
}

/* xorshift64*, S. Vigna, ACM Trans. Math. Softw. 42 (2016) 30. */
static size_t draw(size_t below)
{
    static uint64_t state = 20141219;
    state ^= state >> 12;
    state ^= state << 25;
    state ^= state >> 27;
    return below == 0 ? 0 : (size_t)((state * 2685821657736338717ULL >> 16) % below);
}

static const char *const words[] = {"0",
                                    "-1",
                                    "1",
                                    "2147483648",
                                    "4294967295",
                                    "9223372036854775807",
                                    "nan",
                                    "1e308",
                                    "1e-320",
                                    "inf",
                                    "*",
                                    "$",
                                    ":",
                                    "[",
                                    "]",
                                    "{",
                                    "}",
                                    "\n",
                                    "#",
                                    ",",
                                    "&a",
                                    "*a",
                                    "\xff\xff\xff\xff",
                                    "\x01\x80",
                                    "10000000",
                                    "\"",
                                    "- "};

/* Puts bytes in place of `removed` ones. */
static size_t replace(size_t size, size_t at, size_t removed, const uint8_t *bytes, size_t count)
{
    if (size - removed + count > LARGEST_INPUT)
        return size;
    memmove(mutated + at + count, mutated + at + removed, size - at - removed);
    memmove(mutated + at, bytes, count);
    return size - removed + count;
}

static size_t change(size_t size)
{
    static uint8_t copy[LARGEST_INPUT];
    const size_t at = draw(size);
    const size_t length = draw(size - at < 64 ? size - at : 64);
    const Input *other = &corpus[draw((size_t)corpus_count)];
    const size_t from = draw(other->size);
    const char *word = words[draw(sizeof words / sizeof *words)];
    const uint8_t byte = (uint8_t)draw(256);
    switch (draw(8)) {
    case 0:
        return at;
    case 1:
        return replace(size, at, length, (const uint8_t *)"", 0);
    case 2:
        memcpy(copy, mutated + at, length);
        return replace(size, draw(size), 0, copy, length);
    case 3:
        return replace(size, at, draw(2) ? length : 0, (const uint8_t *)word, strlen(word));
    case 4:
        return replace(size, at, length, other->bytes + from,
                       draw(other->size - from < 256 ? other->size - from : 256));
    case 5:
        return size > 0 ? replace(size, at, 1, &(uint8_t){(uint8_t)(mutated[at] ^ 1U << (byte & 7))}, 1) : size;
    default:
        return size > 0 ? replace(size, at, 1, &byte, 1) : size;
    }
}

static void run_mutation(void)
{
    const Input *base = &corpus[draw((size_t)corpus_count)];
    size_t size = base->size;
    memcpy(mutated, base->bytes, size);
    for (size_t changes = 1 + draw(MOST_CHANGES); changes > 0; changes--)
        size = change(size);
    run((Input){size, mutated});
}

int main(int argc, char **argv)
{
    if (argc != 2 && argc != 3) {
        fprintf(stderr, "usage: %s FILE | %s FOLDER RUNS\n", argv[0], argv[0]);
        return 2;
    }
    LLVMFuzzerInitialize(&argc, &argv);
    signal(SIGABRT, keep_current);
    signal(SIGSEGV, keep_current);
    if (argc == 2) {
        run(read_input(argv[1]));
        return 0;
    }
    read_corpus(argv[1]);
    for (int i = 0; i < corpus_count; i++)
        run(corpus[i]);
    const long runs = strtol(argv[2], NULL, 10);
    for (long i = 0; i < runs; i++)
        run_mutation();
    printf("%d files and %ld mutations of them\n", corpus_count, runs);
    for (int i = 0; i < corpus_count; i++)
        free(corpus[i].bytes);
    return 0;
}
