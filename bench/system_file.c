/* SPDX-License-Identifier: BSD-3-Clause */
#include "system_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char magic[16] = "orthostat-sys-1";

/* An array of the file: where it hangs, and how much of it there is. */
typedef struct Piece {
    void **array;
    size_t count, size;
} Piece;

enum { PIECES = 9 };

static void list_pieces(SystemFile *s, Piece piece[PIECES])
{
    const size_t rows = (size_t)s->rows, ghosts = (size_t)s->ghosts, blocks = (size_t)s->blocks;
    const Piece list[PIECES] = {
        {(void **)&s->row_start, rows + 1, sizeof *s->row_start},
        {(void **)&s->column, blocks, sizeof *s->column},
        {(void **)&s->ghost_row, ghosts, sizeof *s->ghost_row},
        {(void **)&s->label, rows, sizeof *s->label},
        {(void **)&s->value, 9 * blocks, sizeof *s->value},
        {(void **)&s->right_side, 3 * rows, sizeof *s->right_side},
        {(void **)&s->coordinates, 3 * rows, sizeof *s->coordinates},
        {(void **)&s->modes, 18 * rows, sizeof *s->modes},
        {(void **)&s->metric, s->has_metric ? 6 * rows : 0, sizeof *s->metric},
    };
    memcpy(piece, list, sizeof list);
}

static int fail(char *failure, const char *path, const char *what)
{
    snprintf(failure, SYSTEM_FAILURE, "%s: %s", path, what);
    return -1;
}

static int write_all(FILE *stream, SystemFile *s)
{
    const int32_t numbers[6] = {s->rank, s->ranks, s->rows, s->ghosts, s->blocks, s->has_metric};
    const int64_t large[2] = {s->first_row, s->global_rows};
    Piece piece[PIECES];
    list_pieces(s, piece);
    if (fwrite(magic, sizeof magic, 1, stream) != 1 || fwrite(numbers, sizeof numbers, 1, stream) != 1 ||
        fwrite(large, sizeof large, 1, stream) != 1)
        return -1;
    for (int i = 0; i < PIECES; i++)
        if (fwrite(*piece[i].array, piece[i].size, piece[i].count, stream) != piece[i].count)
            return -1;
    return 0;
}

int system_file_write(const SystemFile *system, const char *folder, char *failure)
{
    SystemFile copy = *system; /* of the head alone: the pieces are reached through it */
    char path[SYSTEM_PATH];
    snprintf(path, sizeof path, "%s/system.%d", folder, (int)system->rank);
    FILE *stream = fopen(path, "wb");
    if (!stream)
        return fail(failure, path, "cannot be made");
    const int failed = write_all(stream, &copy);
    if (fclose(stream) != 0 || failed)
        return fail(failure, path, "could not be written in full");
    return 0;
}

static int read_head(FILE *stream, SystemFile *s)
{
    char found[sizeof magic];
    int32_t numbers[6];
    int64_t large[2];
    if (fread(found, sizeof found, 1, stream) != 1 || memcmp(found, magic, sizeof magic) != 0 ||
        fread(numbers, sizeof numbers, 1, stream) != 1 || fread(large, sizeof large, 1, stream) != 1)
        return -1;
    s->rank = numbers[0];
    s->ranks = numbers[1];
    s->rows = numbers[2];
    s->ghosts = numbers[3];
    s->blocks = numbers[4];
    s->has_metric = numbers[5];
    s->first_row = large[0];
    s->global_rows = large[1];
    return s->rows >= 0 && s->ghosts >= 0 && s->blocks >= 0 ? 0 : -1;
}

static int read_all(FILE *stream, SystemFile *s)
{
    Piece piece[PIECES];
    if (read_head(stream, s) != 0)
        return -1;
    list_pieces(s, piece);
    for (int i = 0; i < PIECES; i++) {
        *piece[i].array = malloc(piece[i].count > 0 ? piece[i].count * piece[i].size : 1);
        if (!*piece[i].array || fread(*piece[i].array, piece[i].size, piece[i].count, stream) != piece[i].count)
            return -1;
    }
    return fgetc(stream) == EOF ? 0 : -1;
}

int system_file_read(const char *folder, int rank, SystemFile *system, char *failure)
{
    char path[SYSTEM_PATH];
    memset(system, 0, sizeof *system);
    snprintf(path, sizeof path, "%s/system.%d", folder, rank);
    FILE *stream = fopen(path, "rb");
    if (!stream)
        return fail(failure, path, "cannot be opened; bench_write_system makes it, on as many ranks as will solve it");
    const int failed = read_all(stream, system);
    fclose(stream);
    if (failed || system->rank != rank) {
        system_file_release(system);
        return fail(failure, path, "is not a whole file of bench_write_system");
    }
    return 0;
}

void system_file_release(SystemFile *system)
{
    Piece piece[PIECES];
    list_pieces(system, piece);
    for (int i = 0; i < PIECES; i++)
        free(*piece[i].array);
    memset(system, 0, sizeof *system);
}

static void solution_path(const char *folder, const char *name, int rank, char path[SYSTEM_PATH])
{
    snprintf(path, SYSTEM_PATH, "%s/solution.%s.%d", folder, name, rank);
}

int system_solution_write(const char *folder, const char *name, int rank, int32_t rows, const double *u, char *failure)
{
    char path[SYSTEM_PATH];
    solution_path(folder, name, rank, path);
    FILE *stream = fopen(path, "wb");
    if (!stream)
        return fail(failure, path, "cannot be made");
    const size_t count = 3 * (size_t)rows;
    const size_t written = fwrite(u, sizeof *u, count, stream);
    if (fclose(stream) != 0 || written != count)
        return fail(failure, path, "could not be written in full");
    return 0;
}

int system_solution_read(const char *folder, const char *name, int rank, int32_t rows, double *u, char *failure)
{
    char path[SYSTEM_PATH];
    solution_path(folder, name, rank, path);
    FILE *stream = fopen(path, "rb");
    if (!stream)
        return fail(failure, path, "cannot be opened");
    const size_t count = 3 * (size_t)rows;
    const size_t found = fread(u, sizeof *u, count, stream);
    const int longer = fgetc(stream) != EOF;
    fclose(stream);
    return found == count && !longer ? 0 : fail(failure, path, "does not have three numbers for each row");
}
