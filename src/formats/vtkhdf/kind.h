/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_VTKHDF_KIND_H
#define ORTHOSTAT_FORMATS_VTKHDF_KIND_H

#include "formats/serial/formats.h"
#include "formats/vtkhdf/hdf5.h"

/* Local. Raises OST_INVALID_INPUT unless it is a VTKHDF file of one unstructured grid, of a version that is read. */
OstStatus ost_vtkhdf_check_kind(const OstHdf5 *h5);

/* Local. Notes the names of its fields, as others than the one that was asked for. */
void ost_vtkhdf_note_fields(const OstHdf5 *h5, OstFileField *field);

#endif
