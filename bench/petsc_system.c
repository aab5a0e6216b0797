/* SPDX-License-Identifier: BSD-3-Clause */
#include "petsc_system.h"

#include "process_cost.h"

#include <math.h>

/* a = L L^T and S = L^-1, both lower triangular, row-major. */
static PetscErrorCode FactorBlock(const double *a, PetscScalar *l, PetscScalar *s)
{
    PetscFunctionBeginUser;
    PetscCall(PetscArrayzero(l, 9));
    for (int i = 0; i < 3; i++)
        for (int j = 0; j <= i; j++) {
            double sum = a[3 * i + j];
            for (int k = 0; k < j; k++)
                sum -= l[3 * i + k] * l[3 * j + k];
            PetscCheck(i != j || sum > 0.0, PETSC_COMM_SELF, PETSC_ERR_MAT_CH_ZRPVT, "a diagonal block is indefinite");
            l[3 * i + j] = i == j ? sqrt(sum) : sum / l[4 * j];
        }
    for (int column = 0; column < 3; column++)
        for (int i = 0; i < 3; i++) {
            double sum = i == column ? 1.0 : 0.0;
            for (int k = column; k < i; k++)
                sum -= l[3 * i + k] * s[3 * k + column];
            s[3 * i + column] = i < column ? 0.0 : sum / l[4 * i];
        }
    PetscFunctionReturn(0);
}

/* x = B x or B^T x for a 3×3 block B a node. */
static void MultiplyBlocks(const PetscScalar *blocks, int transposed, PetscInt count, PetscScalar *x)
{
    for (PetscInt n = 0; n < count; n++) {
        const PetscScalar *b = blocks + 9 * n;
        const PetscScalar v[3] = {x[3 * n], x[3 * n + 1], x[3 * n + 2]};
        for (int i = 0; i < 3; i++)
            x[3 * n + i] = transposed ? b[i] * v[0] + b[3 + i] * v[1] + b[6 + i] * v[2]
                                      : b[3 * i] * v[0] + b[3 * i + 1] * v[1] + b[3 * i + 2] * v[2];
    }
}

/* block = s block t^T */
static void ScaleBlock(const PetscScalar *s, const PetscScalar *t, double *block)
{
    double half[9];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            half[3 * i + j] = s[3 * i] * block[j] + s[3 * i + 1] * block[3 + j] + s[3 * i + 2] * block[6 + j];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            block[3 * i + j] = half[3 * i] * t[3 * j] + half[3 * i + 1] * t[3 * j + 1] + half[3 * i + 2] * t[3 * j + 2];
}

/* S of every column, ghosts included. */
static PetscErrorCode FactorDiagonal(const SystemFile *file, PetscSystem *system, Vec *all)
{
    PetscScalar *s;
    PetscInt *ghost;
    PetscFunctionBeginUser;
    PetscCall(PetscMalloc1(file->ghosts, &ghost));
    for (PetscInt g = 0; g < file->ghosts; g++)
        ghost[g] = (PetscInt)file->ghost_row[g];
    PetscCall(VecCreateGhostBlock(PETSC_COMM_WORLD, 9, 9 * file->rows, PETSC_DECIDE, file->ghosts, ghost, all));
    PetscCall(PetscFree(ghost));
    PetscCall(PetscMalloc2(9 * file->rows, &system->scale, 9 * file->rows, &system->unscale));
    for (PetscInt row = 0; row < file->rows; row++)
        for (PetscInt b = file->row_start[row]; b < file->row_start[row + 1]; b++)
            if (file->column[b] == row)
                PetscCall(FactorBlock(file->value + 9 * b, system->unscale + 9 * row, system->scale + 9 * row));
    PetscCall(VecGetArray(*all, &s));
    PetscCall(PetscArraycpy(s, system->scale, 9 * file->rows));
    PetscCall(VecRestoreArray(*all, &s));
    PetscCall(VecGhostUpdateBegin(*all, INSERT_VALUES, SCATTER_FORWARD));
    PetscCall(VecGhostUpdateEnd(*all, INSERT_VALUES, SCATTER_FORWARD));
    PetscFunctionReturn(0);
}

/* A to S A S^T, f to S f, modes to S^-T modes, in the file's own arrays; timed, for it is a peer's setup. */
static PetscErrorCode ScaleSystem(SystemFile *file, PetscSystem *system)
{
    Vec all, local;
    const PetscScalar *s;
    PetscLogDouble start, end;
    PetscFunctionBeginUser;
    PetscCallMPI(MPI_Barrier(PETSC_COMM_WORLD));
    PetscCall(PetscTime(&start));
    system->scaling_processor = -processor_seconds();
    PetscCall(FactorDiagonal(file, system, &all));
    PetscCall(VecGhostGetLocalForm(all, &local));
    PetscCall(VecGetArrayRead(local, &s));
    for (PetscInt row = 0; row < file->rows; row++)
        for (PetscInt b = file->row_start[row]; b < file->row_start[row + 1]; b++)
            ScaleBlock(s + 9 * row, s + 9 * file->column[b], file->value + 9 * b);
    PetscCall(VecRestoreArrayRead(local, &s));
    PetscCall(VecGhostRestoreLocalForm(all, &local));
    PetscCall(VecDestroy(&all));
    MultiplyBlocks(system->scale, 0, file->rows, file->right_side);
    for (PetscInt m = 0; m < 6; m++)
        MultiplyBlocks(system->unscale, 1, file->rows, file->modes + 3 * m * file->rows);
    PetscCallMPI(MPI_Barrier(PETSC_COMM_WORLD));
    PetscCall(PetscTime(&end));
    system->scaling_seconds = end - start;
    system->scaling_processor += processor_seconds();
    PetscFunctionReturn(0);
}

static PetscErrorCode Preallocate(const SystemFile *file, Mat matrix)
{
    PetscInt *own, *foreign;
    PetscFunctionBeginUser;
    PetscCall(PetscCalloc2(file->rows, &own, file->rows, &foreign));
    for (PetscInt row = 0; row < file->rows; row++)
        for (PetscInt b = file->row_start[row]; b < file->row_start[row + 1]; b++)
            (file->column[b] < file->rows ? own : foreign)[row]++;
    PetscCall(MatXAIJSetPreallocation(matrix, 3, own, foreign, NULL, NULL));
    PetscCall(PetscFree2(own, foreign));
    PetscFunctionReturn(0);
}

static PetscErrorCode MakeMatrix(const SystemFile *file, PetscSystem *system)
{
    PetscFunctionBeginUser;
    PetscCall(MatCreate(PETSC_COMM_WORLD, &system->matrix));
    PetscCall(MatSetSizes(system->matrix, 3 * file->rows, 3 * file->rows, PETSC_DETERMINE, PETSC_DETERMINE));
    PetscCall(MatSetBlockSize(system->matrix, 3));
    PetscCall(MatSetType(system->matrix, MATAIJ));
    PetscCall(Preallocate(file, system->matrix));
    for (PetscInt row = 0; row < file->rows; row++) {
        const PetscInt here = (PetscInt)file->first_row + row;
        for (PetscInt b = file->row_start[row]; b < file->row_start[row + 1]; b++) {
            const int32_t c = file->column[b];
            const PetscInt there = (PetscInt)(c < file->rows ? file->first_row + c : file->ghost_row[c - file->rows]);
            PetscCall(MatSetValuesBlocked(system->matrix, 1, &here, 1, &there, file->value + 9 * b, INSERT_VALUES));
        }
    }
    PetscCall(MatAssemblyBegin(system->matrix, MAT_FINAL_ASSEMBLY));
    PetscCall(MatAssemblyEnd(system->matrix, MAT_FINAL_ASSEMBLY));
    PetscCall(MatSetOption(system->matrix, MAT_SYMMETRIC, PETSC_TRUE));
    PetscCall(MatSetOption(system->matrix, MAT_SPD, PETSC_TRUE));
    PetscFunctionReturn(0);
}

static PetscErrorCode MakeVector(Mat matrix, const double *values, PetscInt count, Vec *vector)
{
    PetscScalar *v;
    PetscFunctionBeginUser;
    PetscCall(MatCreateVecs(matrix, vector, NULL));
    PetscCall(VecGetArray(*vector, &v));
    PetscCall(PetscArraycpy(v, values, count));
    PetscCall(VecRestoreArray(*vector, &v));
    PetscFunctionReturn(0);
}

/* PETSc wants all six orthonormal; hypre wants the three rotations as they are. */
static PetscErrorCode TellModes(const SystemFile *file, SystemModes modes, Mat matrix)
{
    const PetscInt first = modes == MODES_ALL ? 0 : 3, count = 6 - first;
    Vec mode[6];
    PetscScalar dots[6];
    MatNullSpace space;
    PetscFunctionBeginUser;
    if (modes == MODES_NONE)
        PetscFunctionReturn(0);
    for (PetscInt m = 0; m < count; m++) {
        PetscCall(MakeVector(matrix, file->modes + 3 * (first + m) * file->rows, 3 * file->rows, &mode[m]));
        for (int pass = 0; pass < 2 && m > 0; pass++) {
            PetscCall(VecMDot(mode[m], m, mode, dots));
            for (PetscInt k = 0; k < m; k++)
                dots[k] = -dots[k];
            PetscCall(VecMAXPY(mode[m], m, dots, mode));
        }
        PetscCall(VecNormalize(mode[m], NULL));
    }
    PetscCall(MatNullSpaceCreate(PETSC_COMM_WORLD, PETSC_FALSE, count, mode, &space));
    PetscCall(MatSetNearNullSpace(matrix, space));
    PetscCall(MatNullSpaceDestroy(&space));
    for (PetscInt m = 0; m < count; m++)
        PetscCall(VecDestroy(&mode[m]));
    PetscFunctionReturn(0);
}

PetscErrorCode PetscSystemRead(const char *folder, PetscBool scaled, SystemModes modes, PetscSystem *system)
{
    SystemFile file;
    char failure[SYSTEM_FAILURE];
    PetscMPIInt rank, ranks;
    PetscFunctionBeginUser;
    PetscCall(PetscMemzero(system, sizeof *system));
    PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
    PetscCallMPI(MPI_Comm_size(PETSC_COMM_WORLD, &ranks));
    PetscCheck(system_file_read(folder, rank, &file, failure) == 0, PETSC_COMM_SELF, PETSC_ERR_FILE_OPEN, "%s",
               failure);
    PetscCheck(file.ranks == ranks, PETSC_COMM_SELF, PETSC_ERR_ARG_WRONG, "%s is of %d ranks, and these are %d", folder,
               (int)file.ranks, (int)ranks);
    system->rows = file.rows;
    if (scaled)
        PetscCall(ScaleSystem(&file, system));
    PetscCall(MakeMatrix(&file, system));
    PetscCall(MakeVector(system->matrix, file.right_side, 3 * file.rows, &system->right_side));
    PetscCall(PetscSystemResidualNorm(system, system->right_side, &system->right_side_norm));
    PetscCall(TellModes(&file, modes, system->matrix));
    system_file_release(&file);
    PetscFunctionReturn(0);
}

PetscErrorCode PetscSystemDestroy(PetscSystem *system)
{
    PetscFunctionBeginUser;
    PetscCall(MatDestroy(&system->matrix));
    PetscCall(VecDestroy(&system->right_side));
    if (system->scale)
        PetscCall(PetscFree2(system->scale, system->unscale));
    PetscFunctionReturn(0);
}

PetscErrorCode PetscSystemResidualNorm(const PetscSystem *system, Vec residual, PetscReal *norm)
{
    const PetscScalar *r;
    PetscReal sum = 0.0;
    PetscFunctionBeginUser;
    if (!system->scale) {
        PetscCall(VecNorm(residual, NORM_2, norm));
        PetscFunctionReturn(0);
    }
    PetscCall(VecGetArrayRead(residual, &r));
    for (PetscInt n = 0; n < system->rows; n++) {
        PetscScalar v[3] = {r[3 * n], r[3 * n + 1], r[3 * n + 2]};
        MultiplyBlocks(system->unscale + 9 * n, 0, 1, v);
        sum += v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    }
    PetscCall(VecRestoreArrayRead(residual, &r));
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPIU_REAL, MPIU_SUM, PETSC_COMM_WORLD));
    *norm = sqrt(sum);
    PetscFunctionReturn(0);
}

PetscErrorCode PetscSystemTrueResidual(const PetscSystem *system, Vec u, PetscReal *relative)
{
    Vec residual;
    PetscFunctionBeginUser;
    PetscCall(VecDuplicate(u, &residual));
    PetscCall(MatMult(system->matrix, u, residual));
    PetscCall(VecAYPX(residual, -1.0, system->right_side));
    PetscCall(PetscSystemResidualNorm(system, residual, relative));
    *relative /= system->right_side_norm;
    PetscCall(VecDestroy(&residual));
    PetscFunctionReturn(0);
}

PetscErrorCode PetscSystemWriteSolution(const PetscSystem *system, const char *folder, const char *name, Vec u)
{
    Vec copy;
    PetscScalar *x;
    PetscMPIInt rank;
    char failure[SYSTEM_FAILURE];
    PetscFunctionBeginUser;
    PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
    PetscCall(VecDuplicate(u, &copy));
    PetscCall(VecCopy(u, copy));
    PetscCall(VecGetArray(copy, &x));
    if (system->scale)
        MultiplyBlocks(system->scale, 1, system->rows, x);
    PetscCheck(system_solution_write(folder, name, rank, system->rows, x, failure) == 0, PETSC_COMM_SELF,
               PETSC_ERR_FILE_WRITE, "%s", failure);
    PetscCall(VecRestoreArray(copy, &x));
    PetscCall(VecDestroy(&copy));
    PetscFunctionReturn(0);
}
