/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CASE_SECTIONS_H
#define ORTHOSTAT_CASE_SECTIONS_H

#include "case/case_data.h"
#include "case/yaml/read.h"

/* The sections of a case file, each read from its node into the case. All are local. What they allocate belongs to the
 * case at once, so a failure leaks nothing. Constraints, springs, loads and watches are added to those that are there.
 */
OstStatus ost_read_mesh(const OstYaml *yaml, const OstYamlNode *node, OstCase *c);
OstStatus ost_read_materials(const OstYaml *yaml, const OstYamlNode *node, OstCase *c);
OstStatus ost_read_constraints(const OstYaml *yaml, const OstYamlNode *node, OstCase *c);
OstStatus ost_read_springs(const OstYaml *yaml, const OstYamlNode *node, OstCase *c);
OstStatus ost_read_loads(const OstYaml *yaml, const OstYamlNode *node, OstCase *c);
OstStatus ost_read_element(const OstYaml *yaml, const OstYamlNode *node, OstCase *c);
OstStatus ost_read_accuracy(const OstYaml *yaml, const OstYamlNode *node, OstCase *c);
OstStatus ost_read_solver(const OstYaml *yaml, const OstYamlNode *node, OstCase *c);
OstStatus ost_read_output(const OstYaml *yaml, const OstYamlNode *node, OstCase *c);
OstStatus ost_read_buckling(const OstYaml *yaml, const OstYamlNode *node, OstCase *c);
OstStatus ost_settle_buckling(const OstYaml *yaml, const OstYamlNode *node, OstCase *c);
OstStatus ost_read_large_rotation(const OstYaml *yaml, const OstYamlNode *node, OstCase *c);
OstStatus ost_read_formulation(const OstYaml *yaml, const OstYamlNode *node, OstCase *c);
OstStatus ost_read_load_path(const OstYaml *yaml, const OstYamlNode *node, OstCase *c);
OstStatus ost_read_watches(const OstYaml *yaml, const OstYamlNode *node, OstCase *c);
OstStatus ost_read_verify(const OstYaml *yaml, const OstYamlNode *node, OstCase *c);

OstStatus ost_read_sweep(const OstYaml *yaml, const OstYamlNode *node, OstCase *c);

/* The load case of this number: what it states is added to the case. For OST_EVERY_LOAD_CASE the names of all, and
 * their loads, supports and springs. */
enum { OST_EVERY_LOAD_CASE = -1 };
OstStatus ost_read_load_cases(const OstYaml *yaml, const OstYamlNode *node, int number, OstCase *c);

/* Can the envelope that `output` may ask for be made? `cases` is NULL if there are none. */
OstStatus ost_check_envelope(const OstYaml *yaml, const OstYamlNode *cases, const OstYamlNode *output, OstCase *c);

/* Do the tables of probes in load cases have names of their own? */
OstStatus ost_check_probe_files(const OstYaml *yaml, const OstYamlNode *output, const OstCase *c);

/* Local. Warns of what is asked for along axes of which one is stated and the others lie anywhere, load cases too. */
void ost_warn_arbitrary_axes(const OstCase *c);

/* Parts of sections. */
OstStatus ost_read_axes(const OstYaml *yaml, const OstYamlNode *node, const char *region, OstCase *c,
                        OstAxesSpec *axes);
OstStatus ost_read_fibre(const OstYaml *yaml, const OstYamlNode *node, OstCase *c, OstAxesSpec *axes);

/* The name of a field of the mesh file, which the case then reads. */
OstStatus ost_read_field(const OstYaml *yaml, const OstYamlNode *node, OstCaseFieldUse use, OstCase *c, char **name);
/* A time table, added to those of the case unless it has the same already; `number` is 1 + its place there. */
OstStatus ost_read_time(const OstYaml *yaml, const OstYamlNode *node, OstCase *c, int *number);
OstStatus ost_read_selection(const OstYaml *yaml, const OstYamlNode *node, OstSelection *selection);
OstStatus ost_read_tolerance(const OstYaml *yaml, const OstYamlNode *node, double *tolerance);

/* Copies a text, or a path, which is made relative to the case file's folder. */
OstStatus ost_read_string(const OstYaml *yaml, const OstYamlNode *node, char **text);
OstStatus ost_read_path(const OstYaml *yaml, const OstYamlNode *node, char **path);

void ost_time_table_release(OstTimeTable *table);
void ost_axes_spec_release(OstAxesSpec *axes);
void ost_selection_release(OstSelection *selection);
/* Do both say the same, word by word? */
int ost_selections_agree(const OstSelection *one, const OstSelection *other);
void ost_load_cases_release(OstCase *c);
void ost_sweep_release(OstCase *c);
void ost_constraint_release(OstConstraint *constraint);
struct OstVerify;
void ost_verify_release(struct OstVerify **verify);

/* Local. Of a case that asks for an accuracy: chooses quadratic tets where linear ones lock, as volume hardly changes,
 * and raises where meshes that are cut cannot hold the same problem. */
OstStatus ost_settle_accuracy(OstCase *c);

#endif
