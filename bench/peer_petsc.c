/* SPDX-License-Identifier: BSD-3-Clause */
#include "petsc_system.h"
#include "process_cost.h"

#include <HYPRE_config.h>
#include <dmumps_c.h>

/* Solves a system of bench_write_system by PETSc's conjugate gradients with the preconditioner that PETSc's own options
 * name, until the true, unscaled residual meets the tolerance. Prints a line of JSON.
 *     -system FOLDER -solution NAME  [-tolerance 1e-8] [-most_iterations 20000] [-scaled] [-modes none|rotations|all]
 */

static const char help[] = "Solves a system of bench_write_system by PETSc; see bench/peer_petsc.c.\n";

enum { MOST_ATTEMPTS = 6 };

typedef struct Options {
    char folder[PETSC_MAX_PATH_LEN], name[64];
    PetscReal tolerance;
    PetscInt most_iterations;
    PetscBool scaled;
    SystemModes modes;
} Options;

/* When the recursive residual, unscaled, has come down to `tolerance`. */
typedef struct Stop {
    const PetscSystem *system;
    PetscReal tolerance;
    PetscInt most_iterations;
    Vec work, residual;
} Stop;

typedef struct Run {
    PetscLogDouble setup, solve;
    PetscLogDouble setup_processor, solve_processor; /* of the rank that took most */
    PetscLogDouble memory[2];                        /* resident before, at the peak; summed over the ranks */
    PetscInt iterations;
    PetscReal residual; /* true, relative, unscaled */
} Run;

static PetscErrorCode ReadOptions(Options *options)
{
    static const char *const names[] = {"none", "rotations", "all", "SystemModes", "", NULL};
    PetscEnum modes = (PetscEnum)MODES_ALL;
    PetscBool found;
    PetscFunctionBeginUser;
    *options = (Options){.tolerance = 1e-8, .most_iterations = 20000};
    PetscCall(PetscOptionsGetString(NULL, NULL, "-system", options->folder, sizeof options->folder, &found));
    PetscCheck(found, PETSC_COMM_WORLD, PETSC_ERR_USER_INPUT, "-system FOLDER is missing");
    PetscCall(PetscOptionsGetString(NULL, NULL, "-solution", options->name, sizeof options->name, &found));
    PetscCheck(found, PETSC_COMM_WORLD, PETSC_ERR_USER_INPUT, "-solution NAME is missing");
    PetscCall(PetscOptionsGetReal(NULL, NULL, "-tolerance", &options->tolerance, NULL));
    PetscCall(PetscOptionsGetInt(NULL, NULL, "-most_iterations", &options->most_iterations, NULL));
    PetscCall(PetscOptionsGetBool(NULL, NULL, "-scaled", &options->scaled, NULL));
    PetscCall(PetscOptionsGetEnum(NULL, NULL, "-modes", names, &modes, NULL));
    options->modes = (SystemModes)modes;
    PetscFunctionReturn(0);
}

static PetscErrorCode HasConverged(KSP solver, PetscInt iteration, PetscReal norm, KSPConvergedReason *reason,
                                   void *context)
{
    const Stop *stop = (const Stop *)context;
    PetscFunctionBeginUser;
    if (stop->system->scale) { /* else `norm` is the one we want; CG hands out the residual that it has at hand */
        Vec residual;
        PetscCall(KSPBuildResidual(solver, stop->work, stop->residual, &residual));
        PetscCall(PetscSystemResidualNorm(stop->system, residual, &norm));
    }
    if (norm <= stop->tolerance * stop->system->right_side_norm)
        *reason = KSP_CONVERGED_RTOL;
    else if (PetscIsInfOrNanReal(norm))
        *reason = KSP_DIVERGED_NANORINF;
    else
        *reason = iteration >= stop->most_iterations ? KSP_DIVERGED_ITS : KSP_CONVERGED_ITERATING;
    PetscFunctionReturn(0);
}

static PetscErrorCode MakeSolver(const PetscSystem *system, Stop *stop, KSP *solver)
{
    PetscFunctionBeginUser;
    PetscCall(VecDuplicate(system->right_side, &stop->work));
    PetscCall(VecDuplicate(system->right_side, &stop->residual));
    PetscCall(KSPCreate(PETSC_COMM_WORLD, solver));
    PetscCall(KSPSetOperators(*solver, system->matrix, system->matrix));
    PetscCall(KSPSetType(*solver, KSPCG));
    PetscCall(KSPSetNormType(*solver, KSP_NORM_UNPRECONDITIONED));
    PetscCall(KSPSetTolerances(*solver, 0.0, 0.0, PETSC_DEFAULT, stop->most_iterations + 1));
    PetscCall(KSPSetConvergenceTest(*solver, HasConverged, stop, NULL));
    PetscCall(KSPSetFromOptions(*solver));
    PetscFunctionReturn(0);
}

/* Where rounding has carried the recursive residual away from the true one, the solve is done again with the stop
 * tightened by as much; the time is that of the solve which met the tolerance. */
static PetscErrorCode SolveToTolerance(KSP solver, Stop *stop, PetscReal tolerance, Vec u, Run *run)
{
    PetscLogDouble start, end;
    KSPConvergedReason reason;
    PetscFunctionBeginUser;
    stop->tolerance = tolerance;
    for (int attempt = 0; attempt < MOST_ATTEMPTS; attempt++) {
        PetscCall(VecZeroEntries(u));
        PetscCallMPI(MPI_Barrier(PETSC_COMM_WORLD));
        PetscCall(PetscTime(&start));
        run->solve_processor = -processor_seconds();
        PetscCall(KSPSolve(solver, stop->system->right_side, u));
        PetscCallMPI(MPI_Barrier(PETSC_COMM_WORLD));
        PetscCall(PetscTime(&end));
        run->solve = end - start;
        run->solve_processor += processor_seconds();
        PetscCall(KSPGetIterationNumber(solver, &run->iterations));
        PetscCall(KSPGetConvergedReason(solver, &reason));
        PetscCall(PetscSystemTrueResidual(stop->system, u, &run->residual));
        if (run->residual <= tolerance || reason < 0)
            break;
        stop->tolerance *= 0.9 * tolerance / run->residual;
    }
    PetscFunctionReturn(0);
}

static PetscErrorCode SetUpAndSolve(const PetscSystem *system, const Options *options, Vec u, Run *run)
{
    Stop stop = {.system = system, .most_iterations = options->most_iterations};
    KSP solver;
    PetscLogDouble start, end;
    PetscFunctionBeginUser;
    PetscCall(MakeSolver(system, &stop, &solver));
    restart_peak_resident();
    run->memory[0] = resident_bytes();
    PetscCallMPI(MPI_Barrier(PETSC_COMM_WORLD));
    PetscCall(PetscTime(&start));
    run->setup_processor = system->scaling_processor - processor_seconds();
    PetscCall(KSPSetUp(solver));
    PetscCall(KSPSetUpOnBlocks(solver));
    PetscCallMPI(MPI_Barrier(PETSC_COMM_WORLD));
    PetscCall(PetscTime(&end));
    run->setup = end - start + system->scaling_seconds;
    run->setup_processor += processor_seconds();
    PetscCall(SolveToTolerance(solver, &stop, options->tolerance, u, run));
    run->memory[1] = peak_resident_bytes();
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &run->setup_processor, 1, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD));
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &run->solve_processor, 1, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD));
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, run->memory, 2, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD));
    PetscCall(KSPDestroy(&solver));
    PetscCall(VecDestroy(&stop.work));
    PetscCall(VecDestroy(&stop.residual));
    PetscFunctionReturn(0);
}

static PetscErrorCode PrintRun(const Run *run, PetscReal tolerance)
{
    PetscFunctionBeginUser;
    PetscCall(PetscPrintf(PETSC_COMM_WORLD,
                          "{\"setup\": %.6f, \"solve\": %.6f, \"setup_processor\": %.6f, \"solve_processor\": %.6f, "
                          "\"iterations\": %d, \"converged\": %s, \"resident_before\": %.0f, \"peak\": %.0f, "
                          "\"version\": \"PETSc %d.%d.%d, hypre %s, MUMPS %s\"}\n",
                          run->setup, run->solve, run->setup_processor, run->solve_processor, (int)run->iterations,
                          run->residual <= tolerance ? "true" : "false", run->memory[0], run->memory[1],
                          PETSC_VERSION_MAJOR, PETSC_VERSION_MINOR, PETSC_VERSION_SUBMINOR, HYPRE_RELEASE_VERSION,
                          MUMPS_VERSION));
    PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
    Options options;
    PetscSystem system;
    Run run = {0};
    Vec u;
    PetscCall(PetscInitialize(&argc, &argv, NULL, help));
    PetscCall(ReadOptions(&options));
    PetscCall(PetscSystemRead(options.folder, options.scaled, options.modes, &system));
    PetscCall(VecDuplicate(system.right_side, &u));
    PetscCall(SetUpAndSolve(&system, &options, u, &run));
    PetscCall(PetscSystemWriteSolution(&system, options.folder, options.name, u));
    PetscCall(PrintRun(&run, options.tolerance));
    PetscCall(VecDestroy(&u));
    PetscCall(PetscSystemDestroy(&system));
    PetscCall(PetscFinalize());
    return 0;
}
