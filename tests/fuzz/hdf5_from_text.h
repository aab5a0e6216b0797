/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_TESTS_FUZZ_HDF5_FROM_TEXT_H
#define ORTHOSTAT_TESTS_FUZZ_HDF5_FROM_TEXT_H

#include <stddef.h>
#include <stdint.h>

/* Writes a sound HDF5 file of whatever contents the text asks for; lines that make no sense are passed over. A line is
 *
 *     NAME TYPE SHAPE [LAYOUT]: VALUES
 *
 * NAME is a dataset's path, an attribute's as /GROUP@ATTRIBUTE, or alone on the line a group's. TYPE is one of i8 u8
 * i16 i32 i64 u64 f32 f64, b32 b64 (integers, big end first), text, textN, ascii or asciiN (strings, of any length or
 * of N bytes). SHAPE is as in 5x3, or - for a single value without dimensions. LAYOUT is contiguous (as it is without),
 * compact, chunked or packed. Values are separated by blanks and repeated as often as it takes; datasets of more than
 * 16,384 are left unwritten. Returns the size of the file. */
size_t write_hdf5_from_text(const uint8_t *text, size_t size, const char *path);

#endif
