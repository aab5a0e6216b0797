/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/yaml/set.h"

#include "case/yaml/message.h"
#include "core/error.h"
#include "core/memory.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LONGEST_STEP = 128, LONGEST_KEY = 1024, MOST_SETTINGS = 255 };

/* What is set, and where the walk along its key has come to. */
typedef struct Setting {
    OstYaml *yaml;
    const char *text;                      /* KEY=VALUE */
    char rest[LONGEST_KEY + LONGEST_STEP]; /* of the key, after the step */
    char step[LONGEST_STEP];
    uint32_t parent, node; /* the step's value is `node`, a child of `parent` */
} Setting;

static OstStatus raise_setting(const Setting *setting, const char *found)
{
    return OST_RAISE(setting->yaml->ctx, OST_INVALID_USAGE, "%s: cannot set %.200s: %s", setting->yaml->path,
                     setting->text, found);
}

/* --- putting nodes in --- */

/* New nodes in place of `removed` ones from `at` on, below `parent`. */
typedef struct Splice {
    uint32_t parent, at, removed;
    const OstYaml *from; /* whose nodes from `first` on are put in */
    uint32_t first;
} Splice;

static uint32_t moved(const Splice *splice, uint32_t index)
{
    return index + (splice->from->count - splice->first) - splice->removed;
}

/* Nodes after the place move, and with them what refers to them: aliases, and the ends of all that is around. */
static OstYamlNode shifted(const Splice *splice, const OstYamlNode *old, uint32_t index)
{
    const uint32_t after = splice->at + splice->removed;
    OstYamlNode node = *old;
    if (index >= after || (index <= splice->parent && node.next >= after))
        node.next = moved(splice, node.next);
    if (node.kind == OST_YAML_ALIAS && node.value >= after)
        node.value = moved(splice, node.value);
    return node;
}

static OstYamlNode brought(const Splice *splice, const OstYaml *to, const OstYamlNode *made)
{
    OstYamlNode node = *made;
    node.line = to->node[splice->removed > 0 ? splice->at : splice->parent].line;
    node.column = to->node[splice->removed > 0 ? splice->at : splice->parent].column;
    node.set = (unsigned)to->settings & 0xff;
    node.next += splice->at - splice->first;
    if (node.kind == OST_YAML_SCALAR)
        node.value += (uint32_t)to->text_size;
    if (node.kind == OST_YAML_ALIAS)
        node.value += splice->at - splice->first;
    return node;
}

static OstStatus check_aliases(const Setting *setting, const Splice *splice)
{
    const OstYaml *yaml = setting->yaml;
    for (uint32_t i = 0; i < yaml->count; i++)
        if (yaml->node[i].kind == OST_YAML_ALIAS && yaml->node[i].value >= splice->at &&
            yaml->node[i].value < splice->at + splice->removed)
            return raise_setting(setting, "an alias (*name) elsewhere in the file stands for what is there; write it "
                                          "out in the file first");
    return OST_SUCCESS;
}

/* Of a sweep no key may change what another one sets: the last would win. */
static OstStatus check_lasting(const Setting *setting, const Splice *splice)
{
    const OstYaml *yaml = setting->yaml;
    for (uint32_t i = splice->at; yaml->lasting > 0 && i < splice->at + splice->removed; i++)
        if ((int)yaml->node[i].set >= yaml->lasting)
            return OST_RAISE(yaml->ctx, OST_INVALID_USAGE,
                             "%s: the sweep sets one value by two keys, %.200s and %.200s; leave one out", yaml->path,
                             yaml->setting[yaml->node[i].set - 1], setting->text);
    return OST_SUCCESS;
}

static OstStatus insert(const Setting *setting, const Splice *splice)
{
    OstYaml *yaml = setting->yaml;
    const OstYaml *from = splice->from;
    OstYamlNode *node = NULL;
    OST_TRY(check_aliases(setting, splice));
    OST_TRY(check_lasting(setting, splice));
    OST_TRY(OST_NEW(yaml->ctx, &node, moved(splice, yaml->count)));
    for (uint32_t i = 0; i < splice->at; i++)
        node[i] = shifted(splice, &yaml->node[i], i);
    for (uint32_t i = splice->first; i < from->count; i++)
        node[splice->at + i - splice->first] = brought(splice, yaml, &from->node[i]);
    for (uint32_t i = splice->at + splice->removed; i < yaml->count; i++)
        node[moved(splice, i)] = shifted(splice, &yaml->node[i], i);
    if (splice->removed == 0)
        node[splice->parent].value++;
    yaml->count = moved(splice, yaml->count);
    OST_FREE(yaml->node);
    yaml->node = node;
    OST_TRY(OST_RESIZE(yaml->ctx, &yaml->text, yaml->text_size + from->text_size));
    memcpy(yaml->text + yaml->text_size, from->text, from->text_size);
    yaml->text_size += from->text_size;
    return OST_SUCCESS;
}

/* --- finding the place --- */

static const OstYamlNode *follow(const Setting *setting, uint32_t node)
{
    return ost_yaml_follow(setting->yaml, &setting->yaml->node[node]);
}

static uint32_t index_of(const Setting *setting, const OstYamlNode *node)
{
    return (uint32_t)(node - setting->yaml->node);
}

static const char *text_of(const Setting *setting, const OstYamlNode *node)
{
    const OstYamlNode *scalar = ost_yaml_follow(setting->yaml, node);
    return scalar->kind == OST_YAML_SCALAR ? setting->yaml->text + scalar->value : "";
}

/* The value of a key, or NULL. */
static const OstYamlNode *value_of(const Setting *setting, const OstYamlNode *mapping, const char *name)
{
    const OstYamlNode *key = mapping + 1;
    for (uint32_t pair = 0; mapping->kind == OST_YAML_MAPPING && pair < mapping->value; pair++) {
        const OstYamlNode *value = ost_yaml_next(setting->yaml, key);
        if (strcmp(text_of(setting, key), name) == 0)
            return value;
        key = ost_yaml_next(setting->yaml, value);
    }
    return NULL;
}

/* Short words of materials, loads and constraints stand for a longer path: the keys that a step means, or NULL. */
static const char *keys_meant(const Setting *setting, const OstYamlNode *mapping, char keys[LONGEST_STEP])
{
    static const char *const stated[] = {"pressure",   "total_force",  "point_force", "traction",  "gravity",
                                         "body_force", "displacement", "spring",      "foundation"};
    const char *step = setting->step;
    const OstYamlNode *modulus = value_of(setting, mapping, "youngs_modulus");
    const int is_material = modulus != NULL;
    keys[0] = 0;
    if (value_of(setting, mapping, step))
        return NULL;
    if (is_material && step[0] == 'E' && step[1] >= '1' && step[1] <= '3' && !step[2] &&
        value_of(setting, ost_yaml_follow(setting->yaml, modulus), "axis"))
        snprintf(keys, LONGEST_STEP, "youngs_modulus.%s", step[1] == '3' ? "axis" : "plane");
    else if (is_material && step[0] == 'E' && step[1] >= '1' && step[1] <= '3' && !step[2])
        snprintf(keys, LONGEST_STEP, "youngs_modulus.%c", step[1] - 1);
    else if (is_material && strcmp(step, "E") == 0)
        snprintf(keys, LONGEST_STEP, "youngs_modulus");
    else if (is_material && strcmp(step, "nu") == 0)
        snprintf(keys, LONGEST_STEP, "poissons_ratio");
    else if (is_material && strncmp(step, "nu", 2) == 0 && isdigit((unsigned char)step[2]))
        snprintf(keys, LONGEST_STEP, "poissons_ratio.%.8s", step);
    else if (is_material && step[0] == 'G' && isdigit((unsigned char)step[1]))
        snprintf(keys, LONGEST_STEP, "shear_modulus.%.8s", step);
    for (size_t i = 0; strcmp(step, "value") == 0 && i < sizeof stated / sizeof *stated; i++)
        if (value_of(setting, mapping, stated[i]))
            snprintf(keys, LONGEST_STEP, "%s", stated[i]);
    return keys[0] ? keys : NULL;
}

/* The number of an entry of a list that the step names, or the count for the next one; -1 if it names none. */
static int entry_number(const Setting *setting, const OstYamlNode *list)
{
    const char *step = setting->step;
    const int count = (int)list->value;
    const OstYamlNode *item = list + 1;
    char *end = NULL;
    const long number = strtol(step, &end, 10);
    if (isdigit((unsigned char)step[0]) && *end == 0)
        return number <= count ? (int)number : -1;
    if (count <= 3 && step[0] >= 'x' && step[0] <= 'z' && !step[1])
        return step[0] - 'x' < count ? step[0] - 'x' : -1;
    for (int i = 0; i < count; i++, item = ost_yaml_next(setting->yaml, item)) {
        const OstYamlNode *entry = ost_yaml_follow(setting->yaml, item);
        const OstYamlNode *region = value_of(setting, entry, "region"), *name = value_of(setting, entry, "name");
        if ((region && strcmp(text_of(setting, region), step) == 0) ||
            (name && strcmp(text_of(setting, name), step) == 0))
            return i;
    }
    return -1;
}

/* The names of a list's entries, and the one nearest to the step. */
static OstStatus raise_no_entry(const Setting *setting, const OstYamlNode *list)
{
    enum { MOST_NAMES = 20 };
    const char *names[MOST_NAMES];
    char place[OST_YAML_PLACE_SIZE], text[OST_YAML_LIST_SIZE], found[OST_YAML_LIST_SIZE + 512], next[64] = "";
    int count = 0;
    const OstYamlNode *item = list + 1;
    for (uint32_t i = 0; i < list->value; i++, item = ost_yaml_next(setting->yaml, item)) {
        const OstYamlNode *entry = ost_yaml_follow(setting->yaml, item);
        const OstYamlNode *name = value_of(setting, entry, "name");
        name = name ? name : value_of(setting, entry, "region");
        if (name && count < MOST_NAMES)
            names[count++] = text_of(setting, name);
    }
    ost_yaml_name_list(names, count, text, sizeof text);
    const char *nearest = ost_nearest_word(setting->step, names, count);
    ost_yaml_place(setting->yaml, list, place, sizeof place);
    if (isdigit((unsigned char)setting->step[0]))
        snprintf(next, sizeof next, "; number %u can be added, as a whole", (unsigned)list->value);
    snprintf(found, sizeof found, "%s has no entry '%s'%s%s%s; it has %u, numbered from 0%s%s%s", place, setting->step,
             nearest ? "; did you mean '" : "", nearest ? nearest : "", nearest ? "'?" : "", (unsigned)list->value,
             count > 0 ? ", of these names: " : "", text, next);
    return raise_setting(setting, found);
}

static OstStatus raise_no_parts(const Setting *setting, const OstYamlNode *scalar)
{
    char place[OST_YAML_PLACE_SIZE], found[512];
    ost_yaml_place(setting->yaml, scalar, place, sizeof place);
    snprintf(found, sizeof found, "%s is the one value '%.60s', which has no part '%s'; set the whole of it", place,
             text_of(setting, scalar), setting->step);
    return raise_setting(setting, found);
}

/* Takes the next step off the key. */
static OstStatus take_step(Setting *setting)
{
    const size_t length = strcspn(setting->rest, ".");
    if (length == 0 || length >= LONGEST_STEP || (setting->rest[length] == '.' && !setting->rest[length + 1]))
        return raise_setting(setting, "expected keys with a dot between them, as in loads.0.pressure=2e5");
    snprintf(setting->step, sizeof setting->step, "%.*s", (int)length, setting->rest);
    const size_t taken = length + (setting->rest[length] == '.');
    memmove(setting->rest, setting->rest + taken, strlen(setting->rest + taken) + 1);
    return OST_SUCCESS;
}

static OstStatus put_before(Setting *setting, const char *keys)
{
    char longer[sizeof setting->rest];
    const int length = snprintf(longer, sizeof longer, "%s%s%s", keys, setting->rest[0] ? "." : "", setting->rest);
    if (length >= (int)sizeof longer)
        return raise_setting(setting, "the key is too long");
    memcpy(setting->rest, longer, (size_t)length + 1);
    return OST_SUCCESS;
}

/* Goes down by one step, unless the mapping lacks that key, or the step is to be a list's next entry. Of such an entry
 * no part can be set: whoever counts from 1 would add a load in place of changing one. */
static OstStatus descend(Setting *setting, int *missing)
{
    char keys[LONGEST_STEP];
    const OstYamlNode *at = follow(setting, setting->node);
    *missing = 0;
    setting->parent = index_of(setting, at);
    if (at->kind == OST_YAML_SCALAR)
        return raise_no_parts(setting, at);
    if (at->kind == OST_YAML_MAPPING && keys_meant(setting, at, keys)) {
        OST_TRY(put_before(setting, keys));
        OST_TRY(take_step(setting));
    }
    if (at->kind == OST_YAML_MAPPING) {
        const OstYamlNode *value = value_of(setting, at, setting->step);
        *missing = !value;
        setting->node = value ? index_of(setting, value) : setting->node;
        return OST_SUCCESS;
    }
    const int number = entry_number(setting, at);
    *missing = number == (int)at->value;
    if (number < 0 || (*missing && setting->rest[0]))
        return raise_no_entry(setting, at);
    if (*missing)
        return OST_SUCCESS;
    const OstYamlNode *item = at + 1;
    for (int i = 0; i < number; i++)
        item = ost_yaml_next(setting->yaml, item);
    setting->node = index_of(setting, item);
    return OST_SUCCESS;
}

/* --- setting --- */

/* A text of some length that grows. */
typedef struct Text {
    OstContext *ctx;
    size_t length;
    char *text;
} Text;

static OstStatus append(Text *text, const char *piece)
{
    const size_t more = strlen(piece);
    OST_TRY(OST_RESIZE(text->ctx, &text->text, text->length + more + 1));
    memcpy(text->text + text->length, piece, more + 1);
    text->length += more;
    return OST_SUCCESS;
}

/* A value that is a text by itself, but would not be one within braces, in quotes. */
static OstStatus append_value(Text *text, const OstYaml *value, const char *written)
{
    const OstYamlNode *root = value->node;
    if (root->kind != OST_YAML_SCALAR || (!root->quoted && !strpbrk(written, ",[]{}:#&*!|>'\"%@`")))
        return append(text, written);
    OST_TRY(append(text, "\""));
    for (const char *from = value->text + root->value; *from; from++) {
        const char letter[3] = {*from == '"' || *from == '\\' ? '\\' : *from,
                                *from == '"' || *from == '\\' ? *from : '\0', '\0'};
        OST_TRY(append(text, letter));
    }
    return append(text, "\"");
}

/* The step and what is left of the key, as "{step: {next: VALUE}}". */
static OstStatus write_pair(Setting *setting, const OstYaml *value, const char *written, Text *text)
{
    int depth = 1;
    OST_TRY(append(text, "{\""));
    OST_TRY(append(text, setting->step));
    for (; setting->rest[0]; depth++) {
        OST_TRY(take_step(setting));
        OST_TRY(append(text, "\": {\""));
        OST_TRY(append(text, setting->step));
    }
    OST_TRY(append(text, "\": "));
    OST_TRY(append_value(text, value, written));
    for (; depth > 0; depth--)
        OST_TRY(append(text, "}"));
    return OST_SUCCESS;
}

/* A new pair at the end of the mapping. */
static OstStatus add_key(Setting *setting, const OstYaml *value, const char *written)
{
    OstYaml *yaml = setting->yaml, *pair = NULL;
    Text text = {.ctx = yaml->ctx};
    OstStatus status = write_pair(setting, value, written, &text);
    if (status == OST_SUCCESS && ost_yaml_parse(yaml->ctx, "--set", text.text, text.length, &pair) != OST_SUCCESS)
        status = raise_setting(setting, "the value is not YAML beside other keys; put a text in quotes, a mapping in "
                                        "braces, a list in brackets");
    if (status == OST_SUCCESS) {
        const Splice splice = {setting->parent, yaml->node[setting->parent].next, 0, pair, 1};
        status = insert(setting, &splice);
    }
    ost_yaml_destroy(&pair);
    OST_FREE(text.text);
    return status;
}

static OstStatus walk_and_set(Setting *setting, const OstYaml *value, const char *written)
{
    OstYaml *yaml = setting->yaml;
    do {
        int missing = 0;
        OST_TRY(take_step(setting));
        OST_TRY(descend(setting, &missing));
        const uint32_t parent = setting->parent;
        if (missing && yaml->node[parent].kind == OST_YAML_MAPPING)
            return add_key(setting, value, written);
        if (missing)
            return insert(setting, &(Splice){parent, yaml->node[parent].next, 0, value, 0});
    } while (setting->rest[0]);
    const uint32_t at = setting->node;
    const Splice splice = {setting->parent, at, yaml->node[at].next - at, value, 0};
    return insert(setting, &splice);
}

static OstStatus keep_text(OstYaml *yaml, const char *text)
{
    if (yaml->settings == MOST_SETTINGS)
        return OST_RAISE(yaml->ctx, OST_INVALID_USAGE, "%s: more than %d settings; put some into the file", yaml->path,
                         MOST_SETTINGS);
    OST_TRY(OST_RESIZE(yaml->ctx, &yaml->setting, yaml->settings + 1));
    yaml->setting[yaml->settings] = NULL;
    yaml->settings++;
    return ost_copy_string(yaml->ctx, text, &yaml->setting[yaml->settings - 1]);
}

OstStatus ost_yaml_set(OstYaml *yaml, const char *text)
{
    Setting setting = {.yaml = yaml, .text = text};
    const char *equals = strchr(text, '=');
    OstYaml *value = NULL;
    OST_TRY(keep_text(yaml, text));
    if (!equals || equals == text || !equals[1 + strspn(equals + 1, " ")])
        return raise_setting(&setting, "expected KEY=VALUE, as in loads.0.pressure=2e5");
    if (equals - text >= LONGEST_KEY)
        return raise_setting(&setting, "the key is too long");
    snprintf(setting.rest, sizeof setting.rest, "%.*s", (int)(equals - text), text);
    OstStatus status =
        ost_yaml_parse(yaml->ctx, yaml->setting[yaml->settings - 1], equals + 1, strlen(equals + 1), &value);
    OST_THEN(walk_and_set(&setting, value, equals + 1));
    ost_yaml_destroy(&value);
    return status;
}
