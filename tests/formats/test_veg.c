/* SPDX-License-Identifier: BSD-3-Clause */
#include "scratch.h"

#include "formats/serial/formats.h"

#include <sys/stat.h>

static OstMeshChunk *chunk;
static OstFileMaterials *materials;

static OstStatus read_mesh(const char *path)
{
    return ost_mesh_file_read(ctx, path, &chunk, &materials);
}

static void drop_mesh(void)
{
    ost_chunk_destroy(&chunk);
    ost_file_materials_destroy(&materials);
}

#define VERTICES "*VERTICES\n5 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 1\n"
#define MESH VERTICES "*ELEMENTS\nTET\n2 4 0\n1 1 2 3 4\n2 2 3 4 5\n"
#define SOFT "*MATERIAL soft\nENU, 900, 2e6, 0.3\n"
#define HARD "*MATERIAL hard\nENU, 1100, 7e6, 0.25\n"

static void read_text(const char *text)
{
    assert_success(read_mesh(write_text("mesh.veg", text)));
}

static void refuse(const char *contents, const char *text)
{
    assert_failure(read_mesh(write_text("bad.veg", contents)), OST_INVALID_INPUT, text);
    assert_non_null(strstr(ost_error_text(ctx), "bad.veg:"));
    assert_null(chunk);
    assert_null(materials);
}

static int region_of(OstGlobal label)
{
    for (OstLocal t = 0; t < chunk->tet_count; t++)
        if (chunk->tet_label[t] == label)
            return chunk->tet_region[t];
    return -1;
}

static void assert_region(OstGlobal label, const char *region, const char *material)
{
    assert_string_equal(chunk->regions.name[region_of(label)], region);
    assert_string_equal(materials->material[region_of(label)].name, material);
    assert_int_equal(materials->count, chunk->regions.count);
}

/* Path of one of the turtle's files, or NULL (with a message) where they are not at hand. */
static const char *turtle(const char *name)
{
    static char path[512];
    const char *source = getenv("ORTHOSTAT_SOURCE");
    snprintf(path, sizeof path, "%s/../shared/data/turtle/%s", source ? source : ".", name);
    if (access(path, R_OK) == 0)
        return path;
    print_message("skipped: %s is not there\n", path);
    return NULL;
}

static void the_homogeneous_turtle_is_read(void **state)
{
    const char *path = turtle("turtle-volumetric-homogeneous.ortho.veg");
    if (!path)
        skip();
    assert_success(read_mesh(path));
    assert_int_equal(chunk->global_nodes, 347);
    assert_int_equal(chunk->global_tets, 1185);
    assert_int_equal(chunk->regions.count, 1);
    assert_string_equal(chunk->regions.name[0], "allElements");
    assert_string_equal(materials->material[0].name, "defaultMaterial");
    assert_true(materials->material[0].constants.youngs_modulus[0] == 25e9);
    assert_int_equal(chunk->boundary_count, 0);
    for (OstLocal n = 0; n < chunk->node_count; n++)
        assert_int_equal(chunk->node_label[n], n + 1);
    drop_mesh();
}

/* Its two sets are in files of their own, included. */
static void the_heterogeneous_turtle_has_a_shell(void **state)
{
    const char *path = turtle("turtle-volumetric-heterogeneous.ortho.veg");
    if (!path)
        skip();
    assert_success(read_mesh(path));
    assert_int_equal(chunk->regions.count, 2);
    int shell = strcmp(chunk->regions.name[0], "backshell") == 0 ? 0 : 1;
    int count[2] = {0, 0};
    for (OstLocal t = 0; t < chunk->tet_count; t++)
        count[chunk->tet_region[t] == shell]++;
    assert_int_equal(count[0], 1040);
    assert_int_equal(count[1], 145);
    const OstMaterial *soft = &materials->material[1 - shell];
    const double modulus[3] = {25e9, 25e5, 25e3};
    for (int i = 0; i < 3; i++) {
        const double pair = sqrt(modulus[i] / modulus[(i + 1) % 3]); /* the family, paper eq. 18 */
        assert_true(soft->constants.youngs_modulus[i] == modulus[i]);
        assert_close(soft->constants.poissons_ratio[i], 0.35 * pair, 1e-12 * pair);
    }
    assert_false(soft->isotropic);
    assert_true(soft->density == 1000.0);
    assert_true(materials->material[shell].isotropic);
    assert_true(materials->material[shell].constants.youngs_modulus[1] == 25e5);
    assert_true(materials->material[shell].constants.poissons_ratio[2] == 0.45);
    drop_mesh();
}

/* R = the rotation about z by 90 degrees: columns (0 1 0), (-1 0 0), (0 0 1). */
#define ROTATION ", 0, -1, 0, 1, 0, 0, 0, 0, 1"

static void every_material_line_is_read(void **state)
{
    static const struct {
        const char *line;
        int nine, rotated;
        double factor;
    } form[] = {
        {"ORTHOTROPIC, 7, 4, 9, 1, 0.1, 0.2, 0.05, 11, 12, 13" ROTATION, 1, 1, 0},
        {"ORTHOTROPIC_N3G3R9, 7, 4, 9, 1, 0.1, 0.2, 0.05, 11, 12, 13" ROTATION, 1, 1, 0},
        {"ORTHOTROPIC_N3G3 7 4 9 1 0.1 0.2 0.05 11 12 13", 1, 0, 0},
        {"ORTHOTROPIC_N1G1R9,7,4,9,1,0.25,1.5" ROTATION, 0, 1, 1.5},
        {"ORTHOTROPIC_N1G1,7,4,9,1,0.25,0.5", 0, 0, 0.5},
        {"ORTHOTROPIC_N1R9,\t7,4,9,1,0.25" ROTATION, 0, 1, 1.0},
        {"ORTHOTROPIC_N1, 7, 4, 9, 1, 0.25", 0, 0, 1.0},
    };
    const double modulus[3] = {4, 9, 1}, ratio[3] = {0.1, 0.2, 0.05}, shear[3] = {11, 12, 13};
    for (size_t f = 0; f < sizeof form / sizeof *form; f++) {
        char text[1024];
        snprintf(text, sizeof text, MESH "*MATERIAL bone\n%s\n", form[f].line);
        read_text(text);
        const OstMaterial *bone = &materials->material[0];
        assert_int_equal(materials->count, 1);
        assert_string_equal(bone->name, "bone");
        assert_true(bone->density == 7.0);
        for (int i = 0; i < 3; i++) {
            const double next = modulus[(i + 1) % 3];
            assert_true(bone->constants.youngs_modulus[i] == modulus[i]);
            assert_close(bone->constants.poissons_ratio[i], form[f].nine ? ratio[i] : 0.25 * sqrt(modulus[i] / next),
                         1e-15);
            assert_close(bone->constants.shear_modulus[i],
                         form[f].nine ? shear[i] : form[f].factor * sqrt(modulus[i] * next) / (2 * 1.25), 1e-14);
        }
        const double plain[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, turned[9] = {0, 1, 0, -1, 0, 0, 0, 0, 1};
        for (int i = 0; i < 9; i++)
            assert_true(materials->axes[i] == (form[f].rotated ? turned : plain)[i]);
        drop_mesh();
    }
}

static void without_a_material_there_is_vegas(void **state)
{
    ost_log_set_level(ctx, OST_LOG_QUIET);
    read_text(MESH);
    ost_log_set_level(ctx, OST_LOG_NORMAL);
    assert_int_equal(materials->count, 1);
    assert_true(materials->material[0].isotropic);
    assert_true(materials->material[0].constants.youngs_modulus[0] == 1e9);
    assert_true(materials->material[0].constants.poissons_ratio[0] == 0.45);
    assert_true(materials->material[0].density == 1000.0);
    assert_string_equal(chunk->regions.name[0], "allElements");
    drop_mesh();
}

static void later_regions_override_and_the_rest_takes_the_last_material(void **state)
{
    read_text(MESH SOFT HARD "*SET a\n1,\n*SET b\n1, 2\n*REGION\na, soft\n");
    assert_region(1, "a", "soft");
    assert_region(2, "rest", "hard");
    drop_mesh();
    read_text(MESH SOFT HARD "*SET a\n1\n*SET b\n1 2\n*REGION\nb, soft\n*REGION\na, hard\n");
    assert_region(1, "a", "hard");
    assert_region(2, "b", "soft");
    drop_mesh();
    read_text(MESH SOFT HARD "*SET a\n1\n*SET b\n1 2\n*REGION\na, hard\n*REGION\nb, soft\n");
    assert_region(1, "b", "soft");
    assert_int_equal(chunk->regions.count, 1);
    drop_mesh();
    read_text(MESH SOFT HARD "*SET a\n1\n*REGION\na, hard\n*REGION\nallElements, soft\n*REGION\na hard\n");
    assert_region(1, "a", "hard");
    assert_region(2, "allElements", "soft");
    drop_mesh();
    read_text(MESH SOFT HARD "*SET rest\n1\n*REGION\nrest, soft\n");
    assert_region(1, "rest", "soft");
    assert_region(2, "rest-2", "hard");
    drop_mesh();
    read_text(MESH SOFT HARD "*REGION\nallElements, soft\n");
    assert_region(2, "allElements", "soft");
    assert_int_equal(chunk->regions.count, 1);
    drop_mesh();
}

static void numbers_start_at_zero_or_one_and_come_in_any_order(void **state)
{
    read_text("*VERTICES\n4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n*ELEMENTS\nTET\n1 4 0\n0 0 1 2 3\n" SOFT
              "*SET s\n0\n*REGION\ns,soft\n");
    assert_int_equal(chunk->node_label[0], 0);
    assert_int_equal(chunk->tet_label[0], 0);
    for (int i = 0; i < 4; i++)
        assert_int_equal(chunk->tet_nodes[i], i);
    drop_mesh();
    ost_log_set_level(ctx, OST_LOG_QUIET);
    read_text("*VERTICES\n4 3 0 0\n4 0 0 1\n2 1 0 0\n1 0 0 0\n3 0 1 0\n*ELEMENTS\nTETRAHEDRON\n1 4 0\n17 1 2 3 4\n" SOFT
              "*SET s\n17\n*REGION\ns,soft\n");
    ost_log_set_level(ctx, OST_LOG_NORMAL);
    const OstGlobal expected[4] = {2, 1, 3, 0};
    for (int i = 0; i < 4; i++)
        assert_int_equal(chunk->tet_nodes[i], expected[i]);
    assert_true(chunk->coordinates[3 * 0 + 2] == 1.0);
    assert_int_equal(chunk->tet_label[0], 17);
    drop_mesh();
}

static void windows_lines_comments_commas_and_spaces_in_names_are_taken(void **state)
{
    read_text("# a mesh\r\n\r\n*VERTICES\r\n4 3 0 0\r\n1,0,0,0\r\n2\t1 0 0\r\n# between\r\n3 0 1e0 0\r\n 4 0 0 +1.0 "
              "\r\n*ELEMENTS\r\nTET\r\n1 4 0\r\n1 1 2 3 4\r\n*MATERIAL my soft one\r\nENU 900 2e6 .3\r\n*SET the lot "
              "\r\n1,\r\n*REGION\r\n the lot , my soft one\r\n");
    assert_region(1, "thelot", "mysoftone");
    drop_mesh();
}

static void files_include_files(void **state)
{
    mkdir(scratch("parts"), 0700);
    write_text("parts/elements.txt", "*INCLUDE more.txt\n2 2 3 4 5\n");
    write_text("parts/more.txt", "1 1 2 3 4\n");
    write_text("parts/rest.veg", SOFT "*SET s\n*INCLUDE ids.txt\n*INCLUDE ids.txt\n*REGION\ns, soft");
    write_text("parts/ids.txt", "1, 2");
    char absolute[1024];
    snprintf(absolute, sizeof absolute, VERTICES "*ELEMENTS\nTET\n2 4 0\n*INCLUDE parts/elements.txt\n*INCLUDE %s\n",
             scratch("parts/rest.veg"));
    read_text(absolute);
    assert_int_equal(chunk->tet_count, 2);
    assert_region(2, "s", "soft");
    drop_mesh();
}

static void endless_and_missing_includes_are_refused(void **state)
{
    refuse(MESH "*INCLUDE bad.veg\n", "bad.veg:13: *INCLUDE of");
    assert_non_null(strstr(ost_error_text(ctx), "it would never end"));
    write_text("a.txt", "*INCLUDE b.txt\n");
    write_text("b.txt", "\n*INCLUDE a.txt\n");
    assert_failure(read_mesh(write_text("loop.veg", "*INCLUDE a.txt\n")), OST_INVALID_INPUT, "b.txt:2: *INCLUDE of");
    assert_failure(read_mesh(write_text("gone.veg", "\n*INCLUDE gone.txt\n")), OST_FILE_FAILED,
                   "gone.txt: cannot be read: No such file");
    assert_non_null(strstr(ost_error_text(ctx), "gone.veg:2: *INCLUDE of"));
    refuse("*INCLUDE\n", "bad.veg:1: *INCLUDE without the name");
    for (int i = 0; i < 20; i++) {
        char name[32], text[64];
        snprintf(name, sizeof name, "deep%d.veg", i);
        snprintf(text, sizeof text, "*INCLUDE deep%d.veg\n", i + 1);
        write_text(name, text);
    }
    assert_failure(read_mesh(scratch("deep0.veg")), OST_INVALID_INPUT,
                   "deep15.veg:1: files include files more than 16");
    write_text("part.txt", "1 0 0 zero\n");
    assert_failure(read_mesh(write_text("part.veg", "*VERTICES\n1 3 0 0\n*INCLUDE part.txt\n")), OST_INVALID_INPUT,
                   "part.txt:1: z is 'zero', expected a number");
}

static void wrong_meshes_are_refused_where_they_are_wrong(void **state)
{
    refuse("", "bad.veg: is empty");
    refuse("# nothing\n", "bad.veg:1: the file ends without *VERTICES");
    refuse(VERTICES, "bad.veg:7: the file ends without *ELEMENTS");
    refuse("1 2 3\n", "bad.veg:1: '1 2 3' found outside of a section");
    refuse(MESH "3 1 2 3 5\n",
           "bad.veg:13: '3 1 2 3 5' found outside of a section, expected a keyword (does the section");
    refuse("*vertices\n", "keyword '*vertices' is unknown, expected *VERTICES, *ELEMENTS");
    refuse("*VERTICES\n", "bad.veg:1: the file ends where the number of vertices is expected");
    refuse("*VERTICES\n*ELEMENTS\n", "bad.veg:2: '*ELEMENTS' found where the number of vertices is expected");
    refuse("*VERTICES\n1.5 3 0 0\n", "is '1.5', expected a whole number");
    refuse("*VERTICES\n0 3 0 0\n", "0 vertices stated, expected at least one");
    refuse("*VERTICES\n-4 3 0 0\n", "-4 vertices stated");
    refuse("*VERTICES\n99999999999 3 0 0\n", "99999999999 vertices stated, at most 2147483647");
    refuse("*VERTICES\n99999999999999999999 3 0 0\n", "expected a whole number");
    refuse("*VERTICES\n2000000000 3 0 0\n1 0 0 0\n", "bad.veg:3: 2000000000 vertices stated, but only 1 follow");
    refuse("*VERTICES\n3 3 0 0\n1 0 0 0\n2 0 0 1\n*ELEMENTS\n", "bad.veg:5: 3 vertices stated, but only 2 follow");
    refuse("*VERTICES\n1 3 0 0\n1 0 0\n", "bad.veg:3: the line ends where z is expected");
    refuse("*VERTICES\n1 3 0 0\n1 0 0 1x\n", "z is '1x', expected a number");
    refuse("*VERTICES\n1 3 0 0\n1 0 nan 0\n", "y is 'nan', expected a finite number");
    refuse("*VERTICES\n1 3 0 0\n1 1e999 0 0\n", "x is '1e999', expected a finite number");
    refuse("*VERTICES\n1 3 0 0\n1 0 0 0 7\n", "'7' follows a vertex's number and three coordinates");
    refuse("*VERTICES\n1 3 0 0\n-1 0 0 0\n", "vertex number -1 found");
    refuse("*VERTICES\n2 3 0 0\n1 0 0 0\n1 1 0 0\n", "bad.veg:4: number 1 is given to two vertices");
    refuse(VERTICES VERTICES, "bad.veg:8: a second *VERTICES");
    refuse(MESH "*ELEMENTS\nTET\n", "bad.veg:13: a second *ELEMENTS");
    refuse("*ELEMENTS\nTET\n1 4 0\n1 1 2 3 4\n", "bad.veg:1: *ELEMENTS before *VERTICES");
    refuse(VERTICES "*ELEMENTS\nCUBIC\n1 8 0\n", "bad.veg:9: elements are CUBIC; only TET can be read");
    refuse(VERTICES "*ELEMENTS\nPRISM\n", "bad.veg:9: elements are 'PRISM', expected TET");
    refuse(VERTICES "*ELEMENTS\nTET\n1 4 0\n1 1 2 3 6\n",
           "bad.veg:11: element 1 uses vertex 6, which is not among the 5");
    refuse(VERTICES "*ELEMENTS\nTET\n1 4 0\n1 1 2 3\n", "bad.veg:11: the line ends where a vertex of the element");
    refuse(VERTICES "*ELEMENTS\nTET\n1 4 0\n1 1 2 3 4 5\n", "'5' follows an element's number and four vertices");
    refuse(VERTICES "*ELEMENTS\nTET\n2 4 0\n7 1 2 3 4\n7 2 3 4 5\n", "number 7 is given to two elements");
    assert_failure(read_mesh(write_bytes("bad.veg", "*VERTICES\n\0", 11)), OST_INVALID_INPUT,
                   "bad.veg:2: holds a zero");
}

static void refuse_material(const char *line, const char *text)
{
    char contents[1024];
    snprintf(contents, sizeof contents, MESH "*MATERIAL m\n%s\n", line);
    refuse(contents, text);
    assert_non_null(strstr(ost_error_text(ctx), "bad.veg:14:"));
}

static void wrong_materials_are_refused(void **state)
{
    refuse_material("MOONEYRIVLIN, 1000, 1, 2, 3", "is MOONEYRIVLIN, which is not linear elastic");
    refuse_material("STVK, 1", "is of kind 'STVK', expected ENU, ORTHOTROPIC");
    refuse_material("ENU, 1000, 1e6", "the line ends where nu is expected");
    refuse_material("ENU, 1000, 1e6, 0.3, 4", "'4' follows the constants of the material");
    refuse_material("ENU, 1000, 1e6, 0.3x", "nu is '0.3x', expected a number");
    refuse_material("ENU, 1000, -1e6, 0.3", "E1 is -1e+06, expected a positive number");
    refuse_material("ENU, 1000, 1e6, 0.5", "nu is 0.5, expected more than -1 and less than 0.5");
    refuse_material("ORTHOTROPIC_N1, 1000, 1, 0, 1, 0.3", "E2 is 0");
    refuse_material("ORTHOTROPIC_N1G1, 1, 1, 1, 1, 0.3, -1", "'m'");
    refuse_material("ORTHOTROPIC_N3G3, 1, 1, 1, 4, 0.45, 0.45, 0.45, 1, 1, 1", "'m'");
    refuse_material("ORTHOTROPIC, 1, 1, 1, 1, 0, 0, 0, 1, 1, 1", "the line ends where R0 is expected");
    refuse_material("ORTHOTROPIC_N1R9, 1, 1, 2, 1, 0.3, 1,0,0, 0,1,0, 0,0,-1", "material 'm' (columns of R)");
    refuse_material("ORTHOTROPIC_N1R9, 1, 1, 2, 1, 0.3, 1,0,0, 0,2,0, 0,0,1", "material 'm' (columns of R)");
    refuse(MESH SOFT SOFT, "bad.veg:16: a second *MATERIAL 'soft'");
    refuse(MESH "*MATERIAL\nENU, 1, 1, 0\n", "bad.veg:13: *MATERIAL without a name");
    refuse(MESH "*MATERIAL m\n", "bad.veg:13: the file ends where the constants of the material are expected");
}

static void wrong_sets_and_regions_are_refused(void **state)
{
    refuse(MESH "*SET s\n1, 3\n", "bad.veg:14: set 's' lists element 3, which is not among the 2 of *ELEMENTS");
    refuse(MESH "*SET s\n1, two\n", "an element of the set is 'two', expected a whole number");
    refuse(MESH "*SET s\n1\n*SET s\n2\n", "bad.veg:15: a second *SET 's'");
    refuse(MESH "*SET allElements\n1\n", "a second *SET 'allElements'");
    refuse(MESH "*SET a,b\n1\n", "the name of *SET holds a comma");
    refuse(VERTICES "*SET s\n1\n", "bad.veg:8: *SET before *ELEMENTS");
    refuse(MESH SOFT "*REGION\ns, soft\n", "bad.veg:16: *REGION uses set 's', which no *SET above defines");
    refuse(MESH "*REGION\nallElements, soft\n" SOFT, "*REGION uses material 'soft', which no *MATERIAL above defines");
    refuse(MESH SOFT "*REGION\nallElements\n", "'allElements' found, expected the names of a set and of a material");
    refuse(MESH SOFT "*REGION\n, soft\n", "the set of a *REGION without a name");
    refuse(MESH SOFT "*REGION\n", "bad.veg:15: the file ends where the names of a set and of a material are expected");
}

static void every_cut_file_is_refused_or_whole(void **state)
{
    static const char whole[] = MESH SOFT HARD "*SET a\n1\n*REGION\na, soft\n";
    const size_t mesh_length = sizeof MESH - 2;
    ost_log_set_level(ctx, OST_LOG_QUIET);
    for (size_t length = 0; length < sizeof whole; length++) {
        const OstStatus status = read_mesh(write_bytes("cut.veg", whole, length));
        if (length < mesh_length)
            assert_int_equal(status, OST_INVALID_INPUT);
        assert_true(status == OST_SUCCESS || strstr(ost_error_text(ctx), "cut.veg:"));
        drop_mesh();
    }
    ost_log_set_level(ctx, OST_LOG_NORMAL);
}

static void damaged_files_do_no_harm(void **state)
{
    static const char whole[] = MESH SOFT HARD "*SET a\n1\n*REGION\na, soft\n";
    char damaged[sizeof whole];
    unsigned random = 99;
    ost_log_set_level(ctx, OST_LOG_QUIET);
    for (int i = 0; i < 3000; i++) {
        memcpy(damaged, whole, sizeof whole);
        for (int k = 0; k < 1 + i % 3; k++) {
            random = random * 1103515245u + 12345u;
            const size_t place = (random >> 8) % (sizeof whole - 1);
            damaged[place] = i % 2 ? (char)random : whole[(random >> 4) % (sizeof whole - 1)];
        }
        const OstStatus status = read_mesh(write_bytes("damaged.veg", damaged, sizeof whole - 1));
        assert_true(status == OST_SUCCESS || strstr(ost_error_text(ctx), "damaged.veg"));
        drop_mesh();
    }
    ost_log_set_level(ctx, OST_LOG_NORMAL);
}

/* Memory goes with what is in the file, not with what it states. */
static void stated_counts_do_not_take_memory(void **state)
{
    const char *path = write_text("large.veg", "*VERTICES\n2000000000 3 0 0\n1 0 0 0\n2 0 0 0\n");
    const size_t before = ost_ledger_peak_bytes(ctx);
    assert_failure(read_mesh(path), OST_INVALID_INPUT, "but only 2 follow");
    assert_true(ost_ledger_peak_bytes(ctx) <= before + 10000);
}

/* It would cost every run 40 ms and 22 MiB. */
static void gmsh_is_not_loaded_for_other_files(void **state)
{
    char line[1024];
    read_text(MESH SOFT);
    drop_mesh();
    FILE *maps = fopen("/proc/self/maps", "r");
    if (!maps)
        skip();
    while (fgets(line, sizeof line, maps))
        assert_null(strstr(line, "libgmsh"));
    fclose(maps);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(the_homogeneous_turtle_is_read),
    cmocka_unit_test(the_heterogeneous_turtle_has_a_shell),
    cmocka_unit_test(every_material_line_is_read),
    cmocka_unit_test(without_a_material_there_is_vegas),
    cmocka_unit_test(later_regions_override_and_the_rest_takes_the_last_material),
    cmocka_unit_test(numbers_start_at_zero_or_one_and_come_in_any_order),
    cmocka_unit_test(windows_lines_comments_commas_and_spaces_in_names_are_taken),
    cmocka_unit_test(files_include_files),
    cmocka_unit_test(endless_and_missing_includes_are_refused),
    cmocka_unit_test(wrong_meshes_are_refused_where_they_are_wrong),
    cmocka_unit_test(wrong_materials_are_refused),
    cmocka_unit_test(wrong_sets_and_regions_are_refused),
    cmocka_unit_test(every_cut_file_is_refused_or_whole),
    cmocka_unit_test(damaged_files_do_no_harm),
    cmocka_unit_test(stated_counts_do_not_take_memory),
    cmocka_unit_test(gmsh_is_not_loaded_for_other_files),
};

OST_TEST_MAIN(tests)
