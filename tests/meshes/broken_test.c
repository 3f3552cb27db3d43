/* Every way of being broken, with its exact words. */
#include "tests/meshes/files.h"

#include <sys/stat.h>
#include <unistd.h>

static void bad(const char *path, mesh_status status, const char *want) {
    mesh_options options = mesh_options_default();
    mesh_surface surface = {.vertex_count = 1};
    assert_int_equal(mesh_load(path, &options, &surface, NULL), status);
    char text[1200];
    snprintf(text, sizeof text, "%s: %s", path, want);
    assert_string_equal(mesh_error_text(), text);
    assert_null(surface.vertex);
    assert_int_equal(surface.vertex_count, 0);
}

static void no_file(void **state) {
    (void)state;
    bad("none.stl", MESH_ERR_OPEN, "cannot be opened: No such file or directory");
    assert_true(mkdir("folder.stl", 0777) == 0 || access("folder.stl", F_OK) == 0);
    bad("folder.stl", MESH_ERR_OPEN, "not a file but a folder");
    unlink("pipe.stl");
    assert_int_equal(mkfifo("pipe.stl", 0666), 0);
    bad("pipe.stl", MESH_ERR_OPEN, "not a file but a device or pipe");
    unlink("pipe.stl");
}

static void broken_binary_stl(void **state) {
    (void)state;
    enum { SIZE = 84 + 12 * 50 };
    unsigned char box[SIZE + 2] = {0}, copy[SIZE + 2];
    mesh_surface s;
    assert_int_equal(mesh_make_box((double[3]){0.19, 1, 0.03}, &s), MESH_OK);
    assert_int_equal(mesh_write_stl(&s, "box.stl"), MESH_OK);
    mesh_free(&s);
    FILE *file = fopen("box.stl", "rb");
    assert_true(file && fread(box, 1, SIZE, file) == SIZE && fclose(file) == 0);
    put("empty.stl", box, 0);
    bad("empty.stl", MESH_ERR_FORMAT, "empty, 0 bytes");
    put("cut.stl", box, 400);
    bad("cut.stl", MESH_ERR_FORMAT,
        "cut off or not an STL file: its header announces 12 triangles, 684 bytes, but it has 400 "
        "bytes");
    put("head.stl", box, 50);
    bad("head.stl", MESH_ERR_FORMAT,
        "not an STL file: 50 bytes that neither start with solid nor hold the 84 bytes of a binary "
        "header");
    put("long.stl", box, SIZE + 2);
    bad("long.stl", MESH_ERR_FORMAT,
        "cut off or not an STL file: its header announces 12 triangles, 684 bytes, but it has 686 "
        "bytes");
    memcpy(copy, box, sizeof box);
    memcpy(copy, "solid", 5); /* many programs begin binary files so */
    put("solid.stl", copy, SIZE);
    assert_true(good("solid.stl").closed);
    const float nowhere = NAN, far = 3e37f;
    memcpy(copy + 84 + 4 * 50 + 24, &nowhere, 4);
    put("nan.stl", copy, SIZE);
    bad("nan.stl", MESH_ERR_FORMAT, "triangle 5, corner 2 at (nan, -0.5, -0.015) m: not a place");
    memcpy(copy + 84 + 4 * 50 + 24, &far, 4);
    put("far.stl", copy, SIZE);
    bad("far.stl", MESH_ERR_FORMAT,
        "triangle 5, corner 2 at (3e+37, -0.5, -0.015) m: more than 1e6 m away");
    memset(copy + 80, 0, 4);
    put("none.stl", copy, 84);
    bad("none.stl", MESH_ERR_FORMAT, "a binary STL of 0 triangles");
    unlink("none.stl");
    put("picture.stl", "\x89PNG\r\n\x1a\n", 8);
    bad("picture.stl", MESH_ERR_FORMAT,
        "not an STL file: 8 bytes that neither start with solid nor hold the 84 bytes of a binary "
        "header");
}

static void broken_text_stl(void **state) {
    (void)state;
    put("cut.stl", STL_TEXT, strlen(STL_TEXT) - 20);
    bad("cut.stl", MESH_ERR_FORMAT, "cut off: a text STL that does not end in endsolid");
    put_changed("nan.stl", STL_TEXT, "vertex 1 1 0", "vertex 1 nan 0");
    bad("nan.stl", MESH_ERR_FORMAT, "triangle 2, corner 2 at (1, nan, 0) m: not a place");
    put_changed("word.stl", STL_TEXT,
                "vertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid two\n",
                "vertex 1 one endsolid");
    bad("word.stl", MESH_ERR_FORMAT,
        "not a mesh that can be read: Cannot parse string \"one endsolid\" as a real number: does "
        "not start with digit or decimal point followed by digit.");
    put_changed("lost.stl", STL_TEXT, "vertex 1 1 0\n", "");
    bad("lost.stl", MESH_ERR_FORMAT,
        "not a mesh that can be read: STL: Invalid number of vertices");
    put_changed("four.stl", STL_TEXT, "vertex 1 1 0\n", "vertex 1 1 0\nvertex 2 2 0\n");
    bad("four.stl", MESH_ERR_FORMAT,
        "damaged: STL: a facet with more than 3 vertices has been found");
    put_text("none.stl", "solid\nendsolid\n");
    mesh_options options = mesh_options_default();
    mesh_surface surface;
    assert_int_equal(mesh_load("none.stl", &options, &surface, NULL), MESH_ERR_FORMAT);
    unlink("none.stl");
}

static void broken_others(void **state) {
    (void)state;
    put_text("hello.ply", "hello world\n");
    bad("hello.ply", MESH_ERR_FORMAT, "not a PLY file: it does not start with ply");
    put("cut.ply", PLY_TEXT, strlen(PLY_TEXT) - 8);
    bad("cut.ply", MESH_ERR_FORMAT, "cut off: its header announces 6 lines, but 5 follow");
    put("head.ply", PLY_TEXT, 60);
    bad("head.ply", MESH_ERR_FORMAT, "cut off: no end_header");
    put_changed("cut2.ply", PLY_TEXT, "ascii", "binary_little_endian");
    bad("cut2.ply", MESH_ERR_FORMAT,
        "cut off: its header announces 74 bytes or more, but 40 follow");
    put_changed("corner.ply", PLY_TEXT, "3 0 2 3", "3 0 2 9");
    bad("corner.ply", MESH_ERR_FORMAT,
        "not a mesh that can be read: Validation failed: aiMesh::mFaces[1]::mIndices[2] is out of "
        "range");
    put_changed("cornerless.ply", PLY_TEXT, "3 0 2 3", "0");
    bad("cornerless.ply", MESH_ERR_FORMAT, "damaged: a face without corners");
    put_changed("corner.obj", OBJ_TEXT, "2 3 4", "2 3 9");
    bad("corner.obj", MESH_ERR_FORMAT,
        "not a mesh that can be read: OBJ: vertex index out of range");
    put_changed("nan.obj", OBJ_TEXT, "v 1 1 0", "v 1 1 nan");
    bad("nan.obj", MESH_ERR_FORMAT, "triangle 1, corner 3 at (1, 1, nan) m: not a place");
    put_text("line.obj", "v 0 0 0\nv 1 1 1\nl 1 2\n");
    bad("line.obj", MESH_ERR_FORMAT, "no triangles in it, 2 vertices, 1 points and lines");
    put_changed("corner.off", OFF_TEXT, "0 2 3", "0 2 9");
    bad("corner.off", MESH_ERR_FORMAT, "damaged: OFF: Vertex index is out of range");
    put_text("notes.txt", "hello world\n");
    bad("notes.txt", MESH_ERR_FORMAT,
        "not a mesh that can be read: No suitable reader found for the file format of file "
        "\"notes.txt\".");
}

TEST_MAIN(cmocka_unit_test(no_file), cmocka_unit_test(broken_binary_stl),
          cmocka_unit_test(broken_text_stl), cmocka_unit_test(broken_others))
