/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CORE_NUMBER_RANGE_H
#define ORTHOSTAT_CORE_NUMBER_RANGE_H

/* What keeps all computed numbers within double precision. Norms and energies are sums of squares, which can hold
 * 1e-308 to 1e308: displacements must stay within 1e-150 to 1e150, and so their factors, loads and stiffness, within
 * these. Beyond, a norm underflows to zero and a displacement of zero would pass for an answer. */
#define OST_LEAST_NUMBER 1e-75
#define OST_MOST_NUMBER 1e75

#endif
