/* SPDX-License-Identifier: BSD-3-Clause */
#include "system_file.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* The judge of scripts/bench-peers, the same for all: ||f - A u|| / ||f|| of a solution, unscaled, every row summed in
 * long double, and how far it is from another solution. One process reads what all ranks wrote. Arguments: folder,
 * name, name of the other (optional). Prints a line of JSON. */

typedef struct Body {
    int32_t ranks;
    int64_t rows;
    double *u, *other; /* 3 × rows */
} Body;

static void stop(const char *failure)
{
    fprintf(stderr, "bench_check_solution: %s\n", failure);
    exit(1);
}

static void read_rows(const char *folder, int rank, SystemFile *system)
{
    char failure[SYSTEM_FAILURE];
    if (system_file_read(folder, rank, system, failure) != 0)
        stop(failure);
}

static double *read_solution(const char *folder, const char *name, const Body *body)
{
    double *u = malloc(3 * (size_t)body->rows * sizeof *u);
    char failure[SYSTEM_FAILURE];
    if (!u)
        stop("out of memory");
    for (int rank = 0; rank < body->ranks; rank++) {
        SystemFile system;
        read_rows(folder, rank, &system);
        if (system_solution_read(folder, name, rank, system.rows, u + 3 * system.first_row, failure) != 0)
            stop(failure);
        system_file_release(&system);
    }
    return u;
}

/* Adds a rank's part of ||f - A u||² and ||f||². */
static void add_residual(const SystemFile *s, const double *u, long double *residual, long double *right_side)
{
    for (int64_t row = 0; row < s->rows; row++)
        for (int i = 0; i < 3; i++) {
            const long double f = s->right_side[3 * row + i];
            long double r = f;
            for (int32_t b = s->row_start[row]; b < s->row_start[row + 1]; b++) {
                const int32_t c = s->column[b];
                const double *x = u + 3 * (c < s->rows ? s->first_row + c : s->ghost_row[c - s->rows]);
                const double *a = s->value + 9 * (int64_t)b + 3 * i;
                r -= (long double)a[0] * x[0] + (long double)a[1] * x[1] + (long double)a[2] * x[2];
            }
            *residual += r * r;
            *right_side += f * f;
        }
}

static double relative_residual(const char *folder, const Body *body)
{
    long double residual = 0.0L, right_side = 0.0L;
    for (int rank = 0; rank < body->ranks; rank++) {
        SystemFile system;
        read_rows(folder, rank, &system);
        add_residual(&system, body->u, &residual, &right_side);
        system_file_release(&system);
    }
    return (double)sqrtl(residual / right_side);
}

static double relative_difference(const Body *body)
{
    double difference = 0.0, size = 0.0;
    for (int64_t i = 0; i < 3 * body->rows; i++) {
        difference += (body->u[i] - body->other[i]) * (body->u[i] - body->other[i]);
        size += body->other[i] * body->other[i];
    }
    return sqrt(difference / size);
}

int main(int argc, char **argv)
{
    SystemFile first;
    Body body = {0};
    if (argc < 3) {
        fputs("usage: bench_check_solution FOLDER NAME [OTHER]\n", stderr);
        return 2;
    }
    read_rows(argv[1], 0, &first);
    body.ranks = first.ranks;
    body.rows = first.global_rows;
    system_file_release(&first);
    body.u = read_solution(argv[1], argv[2], &body);
    printf("{\"unknowns\": %lld, \"residual\": %.6e", (long long)(3 * body.rows), relative_residual(argv[1], &body));
    if (argc > 3) {
        body.other = read_solution(argv[1], argv[3], &body);
        printf(", \"difference\": %.6e", relative_difference(&body));
    }
    puts("}");
    free(body.u);
    free(body.other);
    return 0;
}
