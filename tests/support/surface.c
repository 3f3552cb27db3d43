#include "tests/support/surface.h"

#include "engine/geometry.h"
#include "engine/numbers.h"

static surface scratch; /* too large for a stack */

surface *empty_surface(void) {
    scratch.vertices = scratch.triangles = 0;
    return &scratch;
}

int32_t add_vertex(surface *s, clast_vec3 p) {
    assert_true(s->vertices < MOST_VERTICES);
    s->vertex[s->vertices] = p;
    return s->vertices++;
}

void add_face(surface *s, int32_t a, int32_t b, int32_t c) {
    assert_true(s->triangles < MOST_TRIANGLES);
    int32_t *to = s->corner + 3 * s->triangles++;
    to[0] = a, to[1] = b, to[2] = c;
}

void add_sheet(surface *s, clast_vec3 from, clast_vec3 along, clast_vec3 across, int n, int m,
               dice *d) {
    int32_t first = s->vertices;
    for (int j = 0; j <= m; j++)
        for (int i = 0; i <= n; i++) {
            double x = (double)i / n, y = (double)j / m;
            if (d && i > 0 && i < n) x += roll(d, -.3, .3) / n;
            if (d && j > 0 && j < m) y += roll(d, -.3, .3) / m;
            add_vertex(s, plus(from, plus(times(x, along), times(y, across))));
        }
    for (int j = 0; j < m; j++)
        for (int i = 0; i < n; i++) {
            int32_t a = first + j * (n + 1) + i, b = a + 1, c = b + n + 1, e = a + n + 1;
            bool other = d && roll(d, 0, 1) < .5, turned = d && roll(d, 0, 1) < .5;
            if (other)
                add_face(s, a, b, e), add_face(s, b, c, e);
            else if (turned)
                add_face(s, a, c, b), add_face(s, a, c, e);
            else
                add_face(s, a, b, c), add_face(s, a, c, e);
        }
}

void weld(surface *s) {
    int32_t *to = malloc((size_t)s->vertices * sizeof *to);
    int kept = 0;
    for (int v = 0; v < s->vertices; v++) {
        int k = 0;
        while (k < kept && norm(minus(s->vertex[k], s->vertex[v])) > 1e-12) k++;
        if (k == kept) s->vertex[kept++] = s->vertex[v];
        to[v] = k;
    }
    for (int c = 0; c < 3 * s->triangles; c++) s->corner[c] = to[s->corner[c]];
    s->vertices = kept;
    free(to);
}

surface *box_surface(clast_vec3 half, int n, dice *d) {
    surface *s = empty_surface();
    for (int axis = 0; axis < 3; axis++)
        for (int sign = -1; sign <= 1; sign += 2) {
            double h[3] = {half.x, half.y, half.z};
            double c[3] = {0, 0, 0}, a[3] = {0, 0, 0}, b[3] = {0, 0, 0};
            int u = (axis + 1) % 3, v = (axis + 2) % 3;
            c[axis] = sign * h[axis], c[u] = -h[u], c[v] = -h[v];
            a[u] = 2 * h[u], b[v] = 2 * h[v];
            add_sheet(s, vec(c[0], c[1], c[2]), vec(a[0], a[1], a[2]), vec(b[0], b[1], b[2]), n, n,
                      d);
        }
    weld(s);
    return s;
}

surface *tube_surface(double radius, double half_height, int n, bool lids) {
    surface *s = empty_surface();
    for (int i = 0; i < n; i++) {
        double sine, cosine;
        clast_sincos(2 * NUMBER_PI * i / n, &sine, &cosine);
        add_vertex(s, vec(radius * cosine, radius * sine, -half_height));
        add_vertex(s, vec(radius * cosine, radius * sine, half_height));
    }
    for (int i = 0; i < n; i++) {
        int32_t a = 2 * i, b = 2 * ((i + 1) % n);
        add_face(s, a, b, a + 1), add_face(s, b, b + 1, a + 1);
    }
    for (int end = 0; end < 2 && lids; end++) {
        int32_t middle = add_vertex(s, vec(0, 0, end ? half_height : -half_height));
        for (int i = 0; i < n; i++) add_face(s, middle, 2 * i + end, 2 * ((i + 1) % n) + end);
    }
    return s;
}

void turn_surface(surface *s, clast_quat q, clast_vec3 offset) {
    mat3 r = q_matrix(q);
    for (int v = 0; v < s->vertices; v++) s->vertex[v] = plus(m3_apply(&r, s->vertex[v]), offset);
}

static int mesh_of(clast_world *w, int group, clast_mesh_def d, const surface *s) {
    d.name = "mesh";
    d.vertices = s->vertices, d.triangles = s->triangles;
    d.vertex = s->vertex, d.triangle = s->corner;
    int patches = clast_mesh_add(w, group, &d);
    if (patches < 0) fail_msg("%s", clast_world_error(w));
    return patches;
}

int mesh_with(clast_world *w, int group, int of, const surface *s, double smooth_angle) {
    return mesh_of(w, group, (clast_mesh_def){.material = of, .smooth_angle = smooth_angle}, s);
}

int mesh_on(clast_world *w, int group, int of, const surface *s, clast_vec3 belt) {
    return mesh_of(w, group, (clast_mesh_def){.material = of, .belt_velocity = belt}, s);
}

/* ---- what a sphere feels --------------------------------------------------------------------- */

feeling feel(const clast_world *w, clast_vec3 centre, double radius) {
    wall_touch *touch = calloc((size_t)w->wall_count + 1, sizeof *touch);
    assert_non_null(touch);
    size_t count = 0;
    for (int i = 0; i < w->wall_count; i++) {
        touch[count] = touch_of_wall(&w->walls[i], centre, radius);
        count += touch[count].overlap > 0;
    }
    touches_settle(touch, count);
    feeling f = {{0, 0, 0}, 0, 0};
    for (size_t i = 0; i < count; i++) {
        if (touch[i].hidden) continue;
        f.push = plus(f.push, times(pow(touch[i].overlap, 1.5), touch[i].normal));
        f.deepest = fmax(f.deepest, touch[i].overlap);
        f.walls++;
    }
    free(touch);
    return f;
}

clast_world *feeling_world(const surface *s, double smooth_angle, int *patches) {
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(1, 0);
    two_materials m = add_materials(w, &pair);
    clast_shape_add_sphere(w, "ball", 0.01, m.soft);
    *patches =
        mesh_with(w, clast_part_add(w, &(clast_part_def){.name = "mesh"}), m.hard, s, smooth_angle);
    if (clast_world_prepare(w)) fail_msg("%s", clast_world_error(w));
    return w;
}
