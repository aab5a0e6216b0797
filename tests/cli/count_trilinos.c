/* SPDX-License-Identifier: BSD-3-Clause */
/* Preloaded into the program by test_engine.py: counts the calls of AztecOO's AZ_iterate and of ML's ML_Cycle_MG, and
 * hands them on. Each process adds a line with both to the file that ORTHOSTAT_COUNTS names. */
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>

static long solves, cycles;
static int inside; /* ML calls itself for the levels below */

void AZ_iterate(double *x, double *b, int *options, double *parameters, double *status, int *configuration,
                void *matrix, void *preconditioner, void *scaling);
double ML_Cycle_MG(void *level, double *x, double *b, int guess, void *comm, int norm, void *ml);

void AZ_iterate(double *x, double *b, int *options, double *parameters, double *status, int *configuration,
                void *matrix, void *preconditioner, void *scaling)
{
    void (*real)(double *, double *, int *, double *, double *, int *, void *, void *, void *);
    *(void **)&real = dlsym(RTLD_NEXT, "AZ_iterate");
    solves++;
    real(x, b, options, parameters, status, configuration, matrix, preconditioner, scaling);
}

double ML_Cycle_MG(void *level, double *x, double *b, int guess, void *comm, int norm, void *ml)
{
    double (*real)(void *, double *, double *, int, void *, int, void *);
    *(void **)&real = dlsym(RTLD_NEXT, "ML_Cycle_MG");
    cycles += inside == 0;
    inside++;
    const double result = real(level, x, b, guess, comm, norm, ml);
    inside--;
    return result;
}

__attribute__((destructor)) static void report(void)
{
    const char *path = getenv("ORTHOSTAT_COUNTS");
    FILE *file = path ? fopen(path, "a") : NULL;
    if (!file)
        return;
    fprintf(file, "%ld %ld\n", solves, cycles);
    fclose(file);
}
