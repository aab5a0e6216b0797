/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CORE_INTERRUPT_INTERRUPT_H
#define ORTHOSTAT_CORE_INTERRUPT_INTERRUPT_H

/* What an interrupted program leaves and says. A signal's handler may do little: what it needs is kept here. */

/* Local. From now on SIGINT and SIGTERM remove the files that are half written, say so (`speaks`: of the ranks, one),
 * and end the program with status 130. For programs, not for the library's callers. */
void ost_end_when_interrupted(int speaks);

/* Local. The work is over: signals end the program as they do others. mpirun sends SIGTERM to the ranks that are last
 * to end after a failure, which is no interruption. */
void ost_work_is_over(void);

/* Local. METIS takes a SIGTERM that comes while it works for an error of its own: what it then reports is passed on to
 * the handler above, if there is one. */
void ost_metis_failed(void);

/* Local. A file that is being written aside: removed if the program is interrupted before it is forgotten. */
void ost_half_written(const char *path);
void ost_half_written_forget(const char *path, int is_complete);

/* Local. From now on `tick` is called every second, by a handler: it may do no more than one. */
void ost_tick_every_second(void (*tick)(void));

#endif
