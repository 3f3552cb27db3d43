#include "experiments/clast/stage_walls.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/check.h"

typedef struct polygon {
    int count;
    double at[WALL_VERTICES][3];
} polygon;

static void to_array(clast_vec3 v, double out[3]) {
    out[0] = v.x, out[1] = v.y, out[2] = v.z;
}

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double out[3]) {
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* Where a wall has gone by then; false when its part has been removed. */
static bool pose_of(const stage_wall *w, const frame *f, clast_pose *pose) {
    *pose = (clast_pose){.turn = {1, 0, 0, 0}};
    if (w->part_index < 0 || (size_t)w->part_index >= f->parts)
        return stage_wall_offset(w, f->time, &pose->shift);
    const double *q = f->turn + 4 * w->part_index, *x = f->shift + 3 * w->part_index;
    *pose = (clast_pose){{q[0], q[1], q[2], q[3]}, {x[0], x[1], x[2]}};
    return f->present[w->part_index] != 0;
}

static stage_wall moved(const stage_wall *w, clast_pose pose) {
    stage_wall out = *w;
    clast_pose turn = {.turn = pose.turn};
    out.point = clast_pose_apply(pose, w->point);
    out.normal = clast_pose_apply(turn, w->normal), out.side = clast_pose_apply(turn, w->side);
    return out;
}

static polygon plate_polygon(const stage_wall *w, const double centre[3]) {
    polygon p = {.count = 4};
    double n[3], u[3], v[3];
    to_array(w->normal, n);
    to_array(w->side, u);
    cross(n, u, v);
    static const int SIGNS[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 3; k++)
            p.at[i][k] = centre[k] + SIGNS[i][0] * w->half_side[0] * u[k] +
                         SIGNS[i][1] * w->half_side[1] * v[k];
    return p;
}

/* Where the twelve edges of a box cross a plane: at most six points, in no order yet. */
static polygon crossings(const double point[3], const double n[3], const double low[3],
                         const double high[3]) {
    polygon p = {0};
    for (int axis = 0; axis < 3; axis++)
        for (int corner = 0; corner < 4 && p.count < WALL_VERTICES; corner++) {
            double from[3], to[3];
            int b = (axis + 1) % 3, c = (axis + 2) % 3;
            from[axis] = low[axis], to[axis] = high[axis];
            from[b] = to[b] = corner & 1 ? high[b] : low[b];
            from[c] = to[c] = corner & 2 ? high[c] : low[c];
            double d0 = dot(from, n) - dot(point, n), d1 = dot(to, n) - dot(point, n);
            if ((d0 < 0) == (d1 < 0)) continue;
            double t = d0 / (d0 - d1);
            for (int k = 0; k < 3; k++) p.at[p.count][k] = from[k] + t * (to[k] - from[k]);
            p.count++;
        }
    return p;
}

/* Puts the points in the order of their angle about their middle. */
static void sort_round(polygon *p, const double n[3]) {
    double middle[3] = {0}, u[3], v[3], angle[WALL_VERTICES];
    for (int i = 0; i < p->count; i++)
        for (int k = 0; k < 3; k++) middle[k] += p->at[i][k] / p->count;
    for (int k = 0; k < 3; k++) u[k] = p->at[0][k] - middle[k];
    cross(n, u, v);
    for (int i = 0; i < p->count; i++) {
        double arm[3];
        for (int k = 0; k < 3; k++) arm[k] = p->at[i][k] - middle[k];
        angle[i] = atan2(dot(arm, v), dot(arm, u));
    }
    for (int i = 1; i < p->count; i++)
        for (int j = i; j > 0 && angle[j] < angle[j - 1]; j--) {
            double a = angle[j], at[3];
            angle[j] = angle[j - 1], angle[j - 1] = a;
            memcpy(at, p->at[j], sizeof at);
            memcpy(p->at[j], p->at[j - 1], sizeof at);
            memcpy(p->at[j - 1], at, sizeof at);
        }
}

/* A plane that lies in a face of the box would meet it by chance of rounding: it is cut by a
 * slightly larger box. */
static polygon plane_polygon(const stage_wall *w, const double point[3], const double low[3],
                             const double high[3]) {
    double n[3], wide_low[3], wide_high[3];
    to_array(w->normal, n);
    for (int k = 0; k < 3; k++) {
        double more = 1e-3 * (high[k] - low[k]);
        wide_low[k] = low[k] - more, wide_high[k] = high[k] + more;
    }
    polygon p = crossings(point, n, wide_low, wide_high);
    if (p.count >= 3) sort_round(&p, n);
    return p;
}

/* A fan of triangles. */
static void add_surface(wall_surfaces *w, const polygon *p) {
    size_t i = w->count++;
    double *vertices = w->vertices + i * WALL_VERTICES * 3;
    uint32_t *indices = w->indices + i * WALL_FACES * 3;
    memcpy(vertices, p->at, sizeof p->at);
    for (uint32_t f = 0; (int)f < p->count - 2; f++)
        indices[3 * f] = 0, indices[3 * f + 1] = f + 1, indices[3 * f + 2] = f + 2;
    w->walls[i] = (render_walls){.vertex_count = (size_t)p->count,
                                 .vertex = vertices,
                                 .face_count = (size_t)(p->count - 2),
                                 .corners = 3,
                                 .index = indices,
                                 .colour = {120, 140, 170},
                                 .opacity = 0.15,
                                 .edge_px = 1.5,
                                 .edge_colour = {70, 80, 95}};
}

static void make_room(wall_surfaces *w, const stage *s) {
    size_t vertices = 0, surfaces = s->wall_count + s->mesh_count;
    for (size_t i = 0; i < s->mesh_count; i++) vertices += s->meshes[i].vertex_count;
    w->walls = calloc(surfaces + 1, sizeof *w->walls);
    w->vertices = calloc(s->wall_count + 1, WALL_VERTICES * 3 * sizeof *w->vertices);
    w->indices = calloc(s->wall_count + 1, WALL_FACES * 3 * sizeof *w->indices);
    w->mesh_vertices = calloc(vertices + 1, 3 * sizeof *w->mesh_vertices);
    CLAST_ASSERT(w->walls && w->vertices && w->indices && w->mesh_vertices);
}

/* Quiet tints, by part: which bars move together can be seen. */
static render_rgb tint_of(int part) {
    static const render_rgb TINTS[] = {
        {162, 172, 186}, {205, 178, 142}, {158, 184, 164}, {184, 166, 194}};
    return TINTS[(size_t)part % (sizeof TINTS / sizeof *TINTS)];
}

static void add_mesh(wall_surfaces *w, const stage_mesh *m, double *vertex, clast_pose pose) {
    for (size_t i = 0; i < m->vertex_count; i++) {
        const double *x = m->vertex + 3 * i;
        to_array(clast_pose_apply(pose, (clast_vec3){x[0], x[1], x[2]}), vertex + 3 * i);
    }
    w->walls[w->count++] = (render_walls){.vertex_count = m->vertex_count,
                                          .vertex = vertex,
                                          .face_count = m->triangle_count,
                                          .corners = 3,
                                          .index = m->triangle,
                                          .colour = tint_of(m->part),
                                          .opacity = 1,
                                          .edge_px = 1.2,
                                          .edge_colour = {55, 62, 72}};
}

static void add_meshes(wall_surfaces *w, const stage *s, const frame *f) {
    double *vertex = w->mesh_vertices;
    for (size_t i = 0; i < s->mesh_count; i++) {
        const stage_mesh *m = &s->meshes[i];
        clast_pose pose;
        if (pose_of(&s->walls[m->wall], f, &pose)) add_mesh(w, m, vertex, pose);
        vertex += 3 * m->vertex_count;
    }
}

void wall_surfaces_at(wall_surfaces *w, const stage *s, const frame *f, const double low[3],
                      const double high[3]) {
    CLAST_ASSERT(w && s && f);
    if (!w->walls) make_room(w, s);
    w->count = 0;
    for (size_t i = 0; i < s->wall_count; i++) {
        clast_pose pose;
        if (s->walls[i].kind == CLAST_WALL_PATCH || !s->view.planes ||
            !pose_of(&s->walls[i], f, &pose))
            continue;
        stage_wall l = moved(&s->walls[i], pose);
        double at[3];
        to_array(l.point, at);
        polygon p =
            l.kind == CLAST_WALL_PLATE ? plate_polygon(&l, at) : plane_polygon(&l, at, low, high);
        if (p.count >= 3) add_surface(w, &p);
    }
    add_meshes(w, s, f);
}

void wall_surfaces_free(wall_surfaces *w) {
    free(w->walls), free(w->vertices), free(w->indices), free(w->mesh_vertices);
    *w = (wall_surfaces){0};
}
