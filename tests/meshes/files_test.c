/* Formats that are read, and what comes out. */
#include "tests/meshes/files.h"

#include <unistd.h>

static void formats(void **state) {
    (void)state;
    const char *const path[] = {"two.stl", "two.obj", "two.ply", "two.off"};
    const char *const text[] = {STL_TEXT, OBJ_TEXT, PLY_TEXT, OFF_TEXT};
    for (int i = 0; i < 4; i++) {
        put_text(path[i], text[i]);
        mesh_report r = good(path[i]);
        assert_int_equal(r.triangles_read, 2);
        assert_int_equal(r.loader_warnings, 0);
        assert_int_equal(r.open_edges.count, 4);
        CHECK_CLOSE(r.area, 1.0, 1e-12);
    }
}

/* One triangle twice: moved by 5 along z, and mirrored and stretched by -2 along x. */
static void placed_parts(void **state) {
    (void)state;
    put_text("placed.gltf",
             "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0,1]}],"
             "\"nodes\":[{\"mesh\":0,\"scale\":[-2,1,1]},{\"mesh\":0,\"translation\":[0,0,5]}],"
             "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
             "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,"
             "\"type\":\"VEC3\",\"min\":[0,0,0],\"max\":[1,1,0]}],"
             "\"bufferViews\":[{\"buffer\":0,\"byteOffset\":0,\"byteLength\":36}],"
             "\"buffers\":[{\"byteLength\":36,\"uri\":\"data:application/octet-stream;base64,"
             "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}");
    mesh_options options = mesh_options_default();
    mesh_surface s;
    mesh_report r;
    assert_int_equal(mesh_load("placed.gltf", &options, &s, &r), MESH_OK);
    assert_int_equal(s.triangle_count, 2);
    CHECK_CLOSE(r.area, 1.5, 1e-12);
    CHECK_NEAR(r.low[0], -2, 0);
    CHECK_NEAR(r.high[2], 5, 0);
    for (int t = 0; t < 2; t++) { /* both look along +z, as the file means them to */
        const double *a = s.vertex + 3 * s.triangle[3 * t],
                     *b = s.vertex + 3 * s.triangle[3 * t + 1],
                     *c = s.vertex + 3 * s.triangle[3 * t + 2];
        CHECK_BELOW(0, (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
    }
    mesh_free(&s);
}

static void stored_normals(void **state) {
    (void)state;
    put_changed("against.stl", STL_TEXT, "1 1 0\nvertex 0 1 0", "0 1 0\nvertex 1 1 0");
    mesh_report r = good("against.stl");
    assert_int_equal(r.against.count, 1);
    assert_int_equal(r.against.first, 2);
    assert_int_equal(r.flipped.count, 1);
}

static void remarks_of_the_loader(void **state) {
    (void)state;
    put_changed("remark.obj", OBJ_TEXT, "v 0 0 0", "mtllib none.mtl\nv 0 0 0");
    mesh_report r = good("remark.obj");
    assert_string_equal(r.loader_said, "OBJ: Unable to locate material file none.mtl");
    CHECK_BELOW(0, (double)r.loader_warnings);
}

static void a_million_triangles(void **state) {
    (void)state;
    const mesh_cylinder shape = {0.1, 1.2, 1000, 500};
    mesh_surface s;
    assert_int_equal(mesh_make_cylinder(&shape, &s), MESH_OK);
    assert_int_equal(mesh_write_stl(&s, "million.stl"), MESH_OK);
    mesh_report r = good("million.stl");
    assert_int_equal(r.triangles_read, 1001000);
    assert_int_equal(r.vertices_read - r.joined, s.vertex_count);
    assert_int_equal(r.open_edges.count, 1000);
    unlink("million.stl");
    mesh_free(&s);
}

TEST_MAIN(cmocka_unit_test(formats), cmocka_unit_test(placed_parts),
          cmocka_unit_test(stored_normals), cmocka_unit_test(remarks_of_the_loader),
          cmocka_unit_test(a_million_triangles))
