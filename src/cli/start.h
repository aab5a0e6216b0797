/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CLI_START_H
#define ORTHOSTAT_CLI_START_H

/* What a process does before it starts MPI. */

/* Sets what MPI and the BLAS read from the environment, unless it is set: one thread a rank, as there is one rank a
 * core; no look for GPUs on an X server; and no copies from another process's memory where the system forbids them.
 * OpenBLAS reads it before main: where that was missing, the program starts itself again. */
void ost_cli_settle_environment(char **argv);

/* Was the process started by mpirun, srun or the like? */
int ost_cli_is_launched(void);

/* `scale` without mpirun becomes mpirun with as many ranks as its list asks for. Returns if there is nothing to start,
 * or nothing to start it with. */
void ost_cli_launch_scale(int argc, char **argv);

#endif
