/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CASE_YAML_TREE_H
#define ORTHOSTAT_CASE_YAML_TREE_H

#include "orthostat/context.h"

/* A YAML document as a flat tree in the order of the text: a node's children follow it, `next` is the node after all of
 * them. libyaml parses. The tree is our own because yaml_document_t takes up to 160 times the size of the text (ours at
 * most six times), takes minutes for a megabyte of deep nesting, and loses the places of aliases. */

/* Line and column of a word in the case file, from 1, for messages; zeros if there is none. */
typedef struct OstPlace {
    int line, column;
} OstPlace;

typedef enum { OST_YAML_SCALAR, OST_YAML_SEQUENCE, OST_YAML_MAPPING, OST_YAML_ALIAS } OstYamlKind;

typedef struct OstYamlNode {
    uint64_t line : 24; /* from 0 */
    uint64_t column : 24;
    uint64_t kind : 2;
    uint64_t quoted : 1; /* SCALAR: is in quotes, so it is text even if it reads as a number */
    uint64_t set : 8;    /* 0: the file's; or 1 + the number of the setting that made it (case/yaml/set.h) */
    uint32_t value;      /* SCALAR: where its text starts; SEQUENCE: items; MAPPING: pairs; ALIAS: node it stands for */
    uint32_t next;
} OstYamlNode;

typedef struct OstYaml {
    OstContext *ctx;
    const char *path; /* for messages; not owned */
    uint32_t count;
    OstYamlNode *node; /* node[0] is the document */
    char *text;        /* the scalars, each ended by 0 */
    size_t text_size;
    int settings; /* that have changed the tree, in their words */
    char **setting;
    int lasting; /* settings from this number on (1 is the first) are not set again; 0: all may be */
} OstYaml;

/* Limits; a file beyond them is refused with a message. */
enum { OST_YAML_MAX_BYTES = 1 << 24, OST_YAML_MAX_DEPTH = 32, OST_YAML_MAX_ANCHORS = 256 };

/* Local. Parses `size` bytes of UTF-8. Raises OST_INVALID_INPUT as "path:line:column: ..." for text that is not YAML,
 * an empty file, more than one document, nesting beyond OST_YAML_MAX_DEPTH, an alias within the value it stands for, or
 * aliases that would multiply the size. */
OstStatus ost_yaml_parse(OstContext *ctx, const char *path, const char *bytes, size_t size, OstYaml **yaml);
void ost_yaml_destroy(OstYaml **yaml);

/* Local. The node that an alias stands for, or the node itself; a node's line, from 1; is it (or what it stands for) of
 * a kind? */
const OstYamlNode *ost_yaml_follow(const OstYaml *yaml, const OstYamlNode *node);
int ost_yaml_line(const OstYamlNode *node);
int ost_yaml_is(const OstYaml *yaml, const OstYamlNode *node, OstYamlKind kind);

/* Local. The first child of a sequence or mapping; the node after a node and its children. */
const OstYamlNode *ost_yaml_first(const OstYaml *yaml, const OstYamlNode *node);
const OstYamlNode *ost_yaml_next(const OstYaml *yaml, const OstYamlNode *node);

/* Local. The setting "KEY=VALUE" that made a node (case/yaml/set.h); NULL: the file did. */
const char *ost_yaml_setting(const OstYaml *yaml, const OstYamlNode *node);

#endif
