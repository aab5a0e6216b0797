/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/hash.h"
#include "core/index_map.h"
#include "core/memory.h"
#include "core/parallel/gather.h"
#include "core/write_aside.h"
#include "problem/identity.h"
#include "solve/distributing/turned.h"
#include "solve/path_data.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

/* The file: a header, the steps done, what the answers are made of, and the hash of all that. The answers stand node by
 * node with their labels, so that any number of ranks can take them; multipliers of moved couplings before them. In the
 * byte order of the machine: only the program that wrote it, on such a machine, takes the same bits from it. */
typedef struct Header {
    char magic[16];
    OstProblemIdentity problem;
    uint64_t options, times; /* hashes of the solver's options and of the path's times */
    double t, step;
    int64_t nodes;
    int32_t version, done;
    int32_t parts;     /* of linear answers; 0 if the steps are Newton's */
    int32_t nonlinear; /* then a node has the state's displacement and slope */
} Header;

enum { VERSION = 4, BLOCK = 65536, NODES = 4096 /* in a message */ };
static const char magic[16] = "orthostat path";

/* One number after the other, as a struct has gaps. */
static uint64_t hash_options(const OstSolverOptions *options)
{
    const double numbers[] = {options->method,
                              options->relative_residual,
                              options->accept_attainable,
                              options->max_iterations,
                              options->patience,
                              options->aggregate_nodes,
                              options->coarse_aggregate_nodes,
                              options->smoother_block_nodes,
                              options->smoother_degree,
                              options->smoother_ratio,
                              options->coarsest_unknowns,
                              options->most_levels,
                              options->load_steps,
                              options->factor_memory,
                              options->given};
    return ost_hash(OST_HASH_START, sizeof numbers, numbers);
}

static OstStatus describe(const OstPath *path, Header *header)
{
    *header = (Header){.options = hash_options(&path->analysis->options),
                       .times = ost_hash(OST_HASH_START, (size_t)path->count * sizeof(double), path->times),
                       .t = path->state.t,
                       .step = path->state.step,
                       .nodes = path->problem->mesh->global_nodes,
                       .version = VERSION,
                       .done = path->done,
                       .parts = path->nonlinear ? 0 : path->linear.count,
                       .nonlinear = path->nonlinear};
    memcpy(header->magic, magic, sizeof magic);
    return ost_problem_identify(path->problem, &header->problem);
}

/* What the next step is made from: the parts of linear answers, or the state of Newton's method. */
typedef struct Arrays {
    int count;
    double *one[2];                    /* ost_newton_state_size each */
    double **array;                    /* `one`, or a superposition's parts */
    const OstPressureSpace *pressures; /* of a mixed form, or NULL */
    size_t nodes, numbers;             /* of displacements; of a node in each array, pressures included */
} Arrays;

static void list_arrays(const OstPath *path, Arrays *arrays)
{
    *arrays = (Arrays){
        .count = path->linear.count, .array = path->linear.part, .one = {path->state.displacement, path->state.slope}};
    if (path->nonlinear) {
        arrays->count = 2;
        arrays->array = arrays->one;
    }
    arrays->pressures = path->problem->pressures;
    arrays->nodes = 3 * (size_t)path->problem->mesh->node_count;
    arrays->numbers = 3 + (arrays->pressures ? (size_t)arrays->pressures->most : 0);
}

/* A node's numbers of an array: as many pressures as it has, and zeros for what others have more. */
static void pack_node(const Arrays *arrays, const double *array, size_t node, double *numbers)
{
    memset(numbers, 0, arrays->numbers * sizeof *numbers);
    memcpy(numbers, array + 3 * node, 3 * sizeof *numbers);
    if (arrays->pressures) {
        const OstLocal *first = arrays->pressures->first + node;
        memcpy(numbers + 3, array + arrays->nodes + first[0], (size_t)(first[1] - first[0]) * sizeof *numbers);
    }
}

static void unpack_node(const Arrays *arrays, const double *numbers, size_t node, double *array)
{
    memcpy(array + 3 * node, numbers, 3 * sizeof *numbers);
    if (arrays->pressures) {
        const OstLocal *first = arrays->pressures->first + node;
        memcpy(array + arrays->nodes + first[0], numbers + 3, (size_t)(first[1] - first[0]) * sizeof *numbers);
    }
}

/* A node with its numbers of each array. */
static size_t record_size(const Arrays *arrays)
{
    return sizeof(OstGlobal) + arrays->numbers * (size_t)arrays->count * sizeof(double);
}

/* --- writing: rank 0 writes, and takes the others' arrays in turn --- */

typedef struct Writer {
    FILE *file;
    uint64_t hash;
    int failed; /* errno of the first failure; what else would be written is still taken */
} Writer;

static void put(Writer *writer, size_t size, const void *bytes)
{
    errno = 0;
    if (size == 0)
        return;
    if (!writer->failed && fwrite(bytes, 1, size, writer->file) != size)
        writer->failed = errno ? errno : EIO;
    writer->hash = ost_hash(writer->hash, size, bytes);
}

/* The records of owned nodes from `first` on. */
static int pack(const OstMesh *mesh, const Arrays *arrays, OstLocal first, char *records)
{
    const size_t size = record_size(arrays);
    const int count = mesh->owned_nodes - first < NODES ? mesh->owned_nodes - first : NODES;
    for (int i = 0; i < count; i++) {
        const size_t node = (size_t)first + (size_t)i;
        char *record = records + (size_t)i * size;
        memcpy(record, &mesh->node_label[node], sizeof(OstGlobal));
        record += sizeof(OstGlobal);
        for (int k = 0; k < arrays->count; k++, record += arrays->numbers * sizeof(double))
            pack_node(arrays, arrays->array[k], node, (double *)record);
    }
    return count;
}

/* A rank's records, to rank 0 in messages of so many; the last, perhaps empty, has fewer. */
static OstStatus send_records(OstContext *ctx, const OstMesh *mesh, const Arrays *arrays, char *records)
{
    int count = NODES;
    for (OstLocal first = 0; count == NODES; first += count) {
        count = pack(mesh, arrays, first, records);
        OST_TRY(
            OST_MPI(ctx, MPI_Send(records, (int)(record_size(arrays) * (size_t)count), MPI_BYTE, 0, 0, ost_comm(ctx))));
    }
    return OST_SUCCESS;
}

static OstStatus receive_records(OstContext *ctx, int rank, const Arrays *arrays, char *records, Writer *writer)
{
    const int most = (int)record_size(arrays) * NODES;
    int bytes = most;
    while (bytes == most) {
        MPI_Status received;
        OST_TRY(OST_MPI(ctx, MPI_Recv(records, most, MPI_BYTE, rank, 0, ost_comm(ctx), &received)));
        OST_TRY(OST_MPI(ctx, MPI_Get_count(&received, MPI_BYTE, &bytes)));
        put(writer, (size_t)bytes, records);
    }
    return OST_SUCCESS;
}

static OstStatus put_arrays(const OstPath *path, Writer *writer)
{
    OstContext *ctx = path->ctx;
    const OstMesh *mesh = path->problem->mesh;
    Arrays arrays;
    char *records = NULL;
    list_arrays(path, &arrays);
    OST_TRY(ost_agree(ctx, OST_NEW(ctx, &records, NODES * record_size(&arrays))));
    OstStatus status = OST_SUCCESS;
    if (ost_rank(ctx) > 0)
        status = send_records(ctx, mesh, &arrays, records);
    for (OstLocal first = 0; ost_rank(ctx) == 0 && first < mesh->owned_nodes; first += NODES)
        put(writer, record_size(&arrays) * (size_t)pack(mesh, &arrays, first, records), records);
    for (int rank = 1; ost_rank(ctx) == 0 && rank < ost_size(ctx); rank++)
        OST_THEN(receive_records(ctx, rank, &arrays, records, writer));
    OST_FREE(records);
    return status;
}

/* Multipliers of moved couplings, at the end of a state's displacement and of its slope: how many bytes, and where. */
static size_t size_of_multipliers(const OstPath *path)
{
    return path->nonlinear ? (size_t)ost_turned_couplings_count(path->problem) * sizeof(double) : 0;
}

static double *multipliers_of(const OstPath *path, double *array)
{
    return array ? array + ost_newton_state_size(path->problem) - ost_turned_couplings_count(path->problem) : NULL;
}

/* The rest that is the same on all ranks. */
static void put_reports(const OstPath *path, Writer *writer)
{
    const OstSuperposition *linear = &path->linear;
    put(writer, (size_t)path->done * sizeof *path->steps, path->steps);
    put(writer, sizeof path->judged, &path->judged);
    put(writer, sizeof linear->solve, &linear->solve);
    if (!path->nonlinear)
        put(writer, (size_t)linear->count * sizeof *linear->norm, linear->norm);
    put(writer, size_of_multipliers(path), multipliers_of(path, path->state.displacement));
    put(writer, size_of_multipliers(path), multipliers_of(path, path->state.slope));
}

static OstStatus open_writer(OstContext *ctx, const OstAside *aside, Writer *writer)
{
    *writer = (Writer){.hash = OST_HASH_START};
    if (ost_rank(ctx) != 0)
        return OST_SUCCESS;
    writer->file = fopen(aside->aside, "wb");
    return writer->file
               ? OST_SUCCESS
               : OST_RAISE(ctx, OST_FILE_FAILED, "cannot write the checkpoint '%s': %s", aside->path, strerror(errno));
}

static OstStatus close_writer(OstContext *ctx, const OstAside *aside, Writer *writer)
{
    const uint64_t hash = writer->hash;
    if (ost_rank(ctx) != 0)
        return OST_SUCCESS;
    put(writer, sizeof hash, &hash);
    if (fclose(writer->file) != 0 && !writer->failed)
        writer->failed = errno ? errno : EIO;
    return writer->failed ? OST_RAISE(ctx, OST_FILE_FAILED, "cannot write the checkpoint '%s': %s", aside->path,
                                      strerror(writer->failed))
                          : OST_SUCCESS;
}

static OstStatus write_file(const OstPath *path, const OstAside *aside)
{
    OstContext *ctx = path->ctx;
    Header header;
    Writer writer;
    OST_TRY(describe(path, &header));
    OST_TRY(ost_agree(ctx, open_writer(ctx, aside, &writer)));
    if (ost_rank(ctx) == 0) {
        put(&writer, sizeof header, &header);
        put_reports(path, &writer);
    }
    const OstStatus status = put_arrays(path, &writer);
    const OstStatus closed = close_writer(ctx, aside, &writer);
    return ost_agree(ctx, status == OST_SUCCESS ? closed : status);
}

OstStatus ost_path_save(const OstPath *path, const char *file)
{
    OstContext *ctx = path->ctx;
    OstAside aside = {0};
    ost_ledger_enter(ctx, OST_EFFECT_PATH);
    OstStatus status = ost_aside_open_together(ctx, file, &aside);
    OST_THEN(ost_aside_finish_together(ctx, &aside, write_file(path, &aside)));
    ost_ledger_leave(ctx);
    return status;
}

/* --- reading --- */

static OstStatus raise_damaged(OstContext *ctx, const char *name, const char *what)
{
    return OST_RAISE(ctx, OST_INVALID_INPUT,
                     "%s: this checkpoint cannot be used: %s; delete it, or leave out --resume, to begin the path anew",
                     name, what);
}

/* Is the file whole, byte by byte? */
static OstStatus check_whole(OstContext *ctx, const char *name, FILE *file)
{
    char *bytes = NULL;
    uint64_t hash = OST_HASH_START, stated = 0;
    size_t size = 0, got = 0;
    OST_TRY(OST_NEW(ctx, &bytes, BLOCK + sizeof hash));
    while ((got = fread(bytes + size, 1, BLOCK + sizeof hash - size, file)) > 0) {
        size += got;
        if (size > sizeof hash) { /* the last bytes may be the hash */
            hash = ost_hash(hash, size - sizeof hash, bytes);
            memmove(bytes, bytes + size - sizeof hash, sizeof hash);
            size = sizeof hash;
        }
    }
    memcpy(&stated, bytes, size < sizeof stated ? size : sizeof stated);
    OST_FREE(bytes);
    rewind(file);
    return size == sizeof hash && hash == stated ? OST_SUCCESS
                                                 : raise_damaged(ctx, name, "it is damaged or incomplete");
}

static OstStatus check_header(const OstPath *path, const char *name, const Header *found, const Header *expected)
{
    OstContext *ctx = path->ctx;
    char why[OST_LONGEST_DIFFERENCE];
    if (memcmp(found->magic, magic, sizeof magic) != 0 || found->version != VERSION)
        return raise_damaged(ctx, name, "another version of the program wrote it");
    if (found->options != expected->options)
        return raise_damaged(ctx, name, "the solver's options have changed since");
    if (ost_problem_differs(&found->problem, &expected->problem, why))
        return raise_damaged(ctx, name, why);
    if (found->times != expected->times)
        return raise_damaged(ctx, name, "the path's times have changed since");
    return found->nodes == expected->nodes && found->done >= 0 && found->done <= path->count
               ? OST_SUCCESS
               : raise_damaged(ctx, name, "the mesh has changed since");
}

static OstStatus get(OstContext *ctx, const char *name, FILE *file, size_t size, void *bytes)
{
    return fread(bytes, 1, size, file) == size ? OST_SUCCESS : raise_damaged(ctx, name, "it ends too early");
}

/* Room for what `header` says will come. */
static OstStatus make_room(OstPath *path, const Header *header)
{
    path->decided = header->nonlinear || header->parts > 0; /* not before the first step */
    path->nonlinear = header->nonlinear;
    if (header->parts > 0)
        return ost_superposition_make_room(path->problem, &path->linear);
    if (!header->nonlinear)
        return OST_SUCCESS;
    OST_TRY(ost_agree(path->ctx, ost_newton_state_create(path->problem, &path->state)));
    path->state.t = header->t;
    path->state.step = header->step;
    return OST_SUCCESS;
}

/* The same on all ranks: rank 0 reads, and tells the others. */
static OstStatus get_reports(OstPath *path, const char *name, FILE *file)
{
    OstContext *ctx = path->ctx;
    OstSuperposition *linear = &path->linear;
    struct {
        size_t size;
        void *bytes;
    } const items[] = {{(size_t)path->done * sizeof *path->steps, path->steps},
                       {sizeof path->judged, &path->judged},
                       {sizeof linear->solve, &linear->solve},
                       {(size_t)linear->count * sizeof *linear->norm, linear->norm},
                       {size_of_multipliers(path), multipliers_of(path, path->state.displacement)},
                       {size_of_multipliers(path), multipliers_of(path, path->state.slope)}};
    for (size_t i = 0; i < sizeof items / sizeof *items; i++) {
        if (items[i].size == 0)
            continue;
        OST_TRY(ost_agree(ctx, file ? get(ctx, name, file, items[i].size, items[i].bytes) : OST_SUCCESS));
        OST_TRY(ost_broadcast(ctx, items[i].size, items[i].bytes));
    }
    return OST_SUCCESS;
}

/* Takes what this rank has of these records, ghosts too. */
static void unpack(const OstIndex *nodes, const Arrays *arrays, int count, const char *records, OstLocal *taken)
{
    for (int i = 0; i < count; i++) {
        const char *record = records + (size_t)i * record_size(arrays);
        OstGlobal label;
        memcpy(&label, record, sizeof label);
        record += sizeof label;
        const OstLocal node = ost_index_find(nodes, &label);
        for (int k = 0; node >= 0 && k < arrays->count; k++, record += arrays->numbers * sizeof(double))
            unpack_node(arrays, (const double *)record, (size_t)node, arrays->array[k]);
        *taken += node >= 0;
    }
}

static OstStatus index_nodes(const OstMesh *mesh, OstIndex **nodes)
{
    OST_TRY(ost_index_create(mesh->ctx, 1, nodes));
    for (OstLocal n = 0; n < mesh->node_count; n++) {
        OstLocal place;
        OST_TRY(ost_index_place(*nodes, &mesh->node_label[n], &place));
    }
    return OST_SUCCESS;
}

static OstStatus get_records(const OstPath *path, const char *name, FILE *file, const OstIndex *nodes,
                             const Arrays *arrays, char *records)
{
    OstContext *ctx = path->ctx;
    const OstMesh *mesh = path->problem->mesh;
    OstLocal taken = 0;
    for (OstGlobal first = 0; first < mesh->global_nodes; first += NODES) {
        const int count = mesh->global_nodes - first < NODES ? (int)(mesh->global_nodes - first) : NODES;
        const size_t bytes = (size_t)count * record_size(arrays);
        OST_TRY(ost_agree(ctx, file ? get(ctx, name, file, bytes, records) : OST_SUCCESS));
        OST_TRY(ost_broadcast(ctx, bytes, records));
        unpack(nodes, arrays, count, records, &taken);
    }
    return ost_agree(ctx, taken == mesh->node_count ? OST_SUCCESS
                                                    : raise_damaged(ctx, name, "it has not all of the mesh's nodes"));
}

static OstStatus get_arrays(const OstPath *path, const char *name, FILE *file)
{
    OstContext *ctx = path->ctx;
    OstIndex *nodes = NULL;
    Arrays arrays;
    char *records = NULL;
    list_arrays(path, &arrays);
    if (arrays.count == 0) /* before the first step */
        return OST_SUCCESS;
    OstStatus status = index_nodes(path->problem->mesh, &nodes);
    OST_THEN(OST_NEW(ctx, &records, NODES * record_size(&arrays)));
    status = ost_agree(ctx, status);
    OST_THEN(get_records(path, name, file, nodes, &arrays, records));
    ost_index_destroy(&nodes);
    OST_FREE(records);
    return status;
}

static OstStatus get_head(const OstPath *path, const char *name, FILE *file, const Header *expected, Header *header)
{
    OstContext *ctx = path->ctx;
    OST_TRY(check_whole(ctx, name, file));
    OST_TRY(get(ctx, name, file, sizeof *header, header));
    return check_header(path, name, header, expected);
}

static OstStatus read_file(OstPath *path, const char *name, FILE *file)
{
    OstContext *ctx = path->ctx;
    Header expected, header;
    OST_TRY(describe(path, &expected));
    OST_TRY(ost_agree(ctx, file ? get_head(path, name, file, &expected, &header) : OST_SUCCESS));
    OST_TRY(ost_broadcast(ctx, sizeof header, &header));
    OST_TRY(make_room(path, &header));
    path->done = header.done;
    OST_TRY(get_reports(path, name, file));
    return get_arrays(path, name, file);
}

OstStatus ost_path_resume(OstPath *path, const char *name)
{
    OstContext *ctx = path->ctx;
    FILE *file = NULL;
    int found = 1;
    OstStatus status = OST_SUCCESS;
    ost_ledger_enter(ctx, OST_EFFECT_PATH);
    if (ost_rank(ctx) == 0) {
        file = fopen(name, "rb");
        found = file != NULL || errno != ENOENT;
        if (!file && found)
            status = OST_RAISE(ctx, OST_FILE_FAILED, "cannot read the checkpoint '%s': %s", name, strerror(errno));
    }
    status = ost_agree(ctx, status);
    OST_THEN(ost_broadcast(ctx, sizeof found, &found));
    if (found)
        OST_THEN(read_file(path, name, file));
    if (file)
        fclose(file);
    ost_ledger_leave(ctx);
    return status;
}
