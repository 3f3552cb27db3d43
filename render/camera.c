#include "render/lens.h"
#include "render/status.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double out[3]) {
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* False if too short to have a direction, or not finite. */
static bool normalise(double v[3]) {
    double largest = fmax(fabs(v[0]), fmax(fabs(v[1]), fabs(v[2])));
    if (!(largest > 0) || !isfinite(largest)) return false;
    for (int k = 0; k < 3; k++) v[k] /= largest; /* the square of a tiny vector must not vanish */
    double length = sqrt(dot(v, v));
    for (int k = 0; k < 3; k++) v[k] /= length;
    return isfinite(length);
}

/* right, up and ahead from a line of sight and a rough upward direction. */
static render_status make_frame(const double sight[3], const double upward[3], render_lens *lens) {
    for (int k = 0; k < 3; k++) lens->ahead[k] = sight[k];
    double up[3] = {upward[0], upward[1], upward[2]};
    if (!normalise(lens->ahead))
        return render_fail(RENDER_ERR_ARGUMENT, "camera: the line of sight has no direction");
    if (!normalise(up)) return render_fail(RENDER_ERR_ARGUMENT, "camera: up has no direction");
    cross(lens->ahead, up, lens->right);
    if (dot(lens->right, lens->right) < 1e-12 || !normalise(lens->right))
        return render_fail(RENDER_ERR_ARGUMENT, "camera: up points along the line of sight");
    cross(lens->right, lens->ahead, lens->up);
    return RENDER_OK;
}

static render_status check_angle(double angle_deg) {
    if (angle_deg > 0 && angle_deg < 170) return RENDER_OK;
    return render_fail(RENDER_ERR_ARGUMENT, "camera: angle %g degrees, expected 0 to 170",
                       angle_deg);
}

static render_status check_picture(int width, int height) {
    if (width >= 1 && height >= 1) return RENDER_OK;
    return render_fail(RENDER_ERR_ARGUMENT, "picture of %d x %d pixels, expected at least 1 x 1",
                       width, height);
}

static double half_tangent(double angle_deg) {
    return tan(angle_deg * PI / 360);
}

render_status render_lens_make(render_lens *lens, const render_camera *camera, int width,
                               int height) {
    RENDER_ASSERT(lens && camera);
    double sight[3];
    for (int k = 0; k < 3; k++) {
        lens->eye[k] = camera->eye[k];
        sight[k] = camera->target[k] - camera->eye[k];
    }
    render_status status = check_picture(width, height);
    if (status == RENDER_OK) status = make_frame(sight, camera->up, lens);
    if (status != RENDER_OK) return status;
    lens->perspective = camera->projection == RENDER_PERSPECTIVE;
    if (lens->perspective) {
        status = check_angle(camera->angle_deg);
        if (status != RENDER_OK) return status;
        lens->scale = height / (2 * half_tangent(camera->angle_deg));
    } else {
        if (!(camera->height_m > 0) || !isfinite(camera->height_m))
            return render_fail(RENDER_ERR_ARGUMENT, "camera: height %g m, expected more than 0",
                               camera->height_m);
        lens->scale = height / camera->height_m;
    }
    if (!isfinite(camera->shift_x) || !isfinite(camera->shift_y) || !isfinite(dot(sight, sight)))
        return render_fail(RENDER_ERR_ARGUMENT, "camera: eye, target and shift must be finite");
    lens->width = width;
    lens->height = height;
    lens->centre_x = width * (0.5 + camera->shift_x);
    lens->centre_y = height * (0.5 + camera->shift_y);
    return RENDER_OK;
}

render_view render_view_default(void) {
    return (render_view){
        .projection = RENDER_ORTHOGRAPHIC,
        .direction = {0, 1, 0},
        .up = {0, 0, 1},
        .angle_deg = 30,
        .margins = {24, 24, 24, 24},
    };
}

/* A corner of the box, from its centre, in view axes. */
static void corner_of(const render_lens *frame, const double low[3], const double high[3],
                      int corner, double view[3]) {
    double from_centre[3];
    for (int k = 0; k < 3; k++)
        from_centre[k] = ((corner >> k & 1) ? 0.5 : -0.5) * (high[k] - low[k]);
    view[0] = dot(from_centre, frame->right);
    view[1] = dot(from_centre, frame->up);
    view[2] = dot(from_centre, frame->ahead);
}

/* What of the picture plane the box covers: metres, or slopes if seen from a distance > 0. */
typedef struct cover {
    double x0, x1, y0, y1;
    double depth; /* of the nearest corner before the centre, m */
} cover;

static cover box_cover(const render_lens *frame, const double low[3], const double high[3],
                       double distance) {
    cover c = {HUGE_VAL, -HUGE_VAL, HUGE_VAL, -HUGE_VAL, 0};
    for (int corner = 0; corner < 8; corner++) {
        double view[3];
        corner_of(frame, low, high, corner, view);
        double away = distance > 0 ? distance + view[2] : 1;
        c.x0 = fmin(c.x0, view[0] / away);
        c.x1 = fmax(c.x1, view[0] / away);
        c.y0 = fmin(c.y0, view[1] / away);
        c.y1 = fmax(c.y1, view[1] / away);
        c.depth = fmax(c.depth, -view[2]);
    }
    return c;
}

/* The nearest distance at which the box covers no more slope than allowed, by halving: what it
 * covers shrinks steadily with distance. */
static double fit_distance(const render_lens *frame, const double low[3], const double high[3],
                           double slope_x, double slope_y) {
    cover flat = box_cover(frame, low, high, 0);
    double too_near = flat.depth,
           enough = flat.depth + fmax((flat.x1 - flat.x0) / slope_x, (flat.y1 - flat.y0) / slope_y);
    for (int i = 0; i < 60 && too_near < enough; i++) {
        double middle = 0.5 * (too_near + enough);
        cover c = box_cover(frame, low, high, fmax(middle, 1e-300));
        bool fits = c.x1 - c.x0 <= slope_x && c.y1 - c.y0 <= slope_y;
        *(fits ? &enough : &too_near) = middle;
    }
    return enough > 0 ? enough : 1; /* a point is seen from anywhere */
}

static render_status check_fit(const render_view *view, const double low[3], const double high[3],
                               double room_x, double room_y) {
    for (int k = 0; k < 3; k++)
        if (!isfinite(low[k]) || !isfinite(high[k]) || low[k] > high[k])
            return render_fail(RENDER_ERR_ARGUMENT,
                               "camera: box from %g to %g along axis %d, expected finite and "
                               "ascending",
                               low[k], high[k], k);
    if (!(room_x >= 1) || !(room_y >= 1))
        return render_fail(RENDER_ERR_ARGUMENT,
                           "camera: the margins leave %g x %g pixels for the scene", room_x,
                           room_y);
    return view->projection == RENDER_PERSPECTIVE ? check_angle(view->angle_deg) : RENDER_OK;
}

render_status render_camera_fit(render_camera *camera, const render_view *view, const double low[3],
                                const double high[3], int width, int height) {
    RENDER_ASSERT(camera && view && low && high);
    const render_margins *m = &view->margins;
    double room_x = width - m->left - m->right, room_y = height - m->top - m->bottom;
    render_lens frame = {0};
    render_status status = check_picture(width, height);
    if (status == RENDER_OK) status = check_fit(view, low, high, room_x, room_y);
    if (status == RENDER_OK) status = make_frame(view->direction, view->up, &frame);
    if (status != RENDER_OK) return status;

    bool perspective = view->projection == RENDER_PERSPECTIVE;
    double distance = 0, per_px; /* slope or metres per pixel */
    if (perspective) {
        per_px = 2 * half_tangent(view->angle_deg) / height;
        distance = fit_distance(&frame, low, high, per_px * room_x, per_px * room_y);
    }
    cover c = box_cover(&frame, low, high, distance);
    if (!perspective) {
        per_px = fmax((c.x1 - c.x0) / room_x, (c.y1 - c.y0) / room_y);
        if (per_px <= 0) per_px = 1.0 / height; /* a point: any scale shows it */
        distance = 2 * c.depth + per_px * height;
    }
    *camera = (render_camera){
        .projection = view->projection,
        .height_m = per_px * height,
        .angle_deg = view->angle_deg,
        .shift_x = ((m->left - m->right) / 2 - (c.x0 + c.x1) / (2 * per_px)) / width,
        .shift_y = ((m->bottom - m->top) / 2 - (c.y0 + c.y1) / (2 * per_px)) / height,
    };
    for (int k = 0; k < 3; k++) {
        camera->target[k] = 0.5 * (low[k] + high[k]);
        camera->eye[k] = camera->target[k] - distance * frame.ahead[k];
        camera->up[k] = frame.up[k];
    }
    return RENDER_OK;
}

render_status render_camera_fit_scene(render_camera *camera, const render_view *view,
                                      const render_scene *scene, int width, int height) {
    double low[3], high[3];
    render_scene_bounds(scene, low, high);
    return render_camera_fit(camera, view, low, high, width, height);
}

bool render_camera_project(const render_camera *camera, int width, int height,
                           const double point[3], double pixel[2], double *depth_m) {
    RENDER_ASSERT(point && pixel);
    render_lens lens;
    if (render_lens_make(&lens, camera, width, height) != RENDER_OK) return false;
    double view[3];
    render_lens_view(&lens, point[0], point[1], point[2], view);
    if (depth_m) *depth_m = view[2];
    if (lens.perspective && !(view[2] > 0)) return false;
    double scale = render_lens_scale(&lens, view[2]);
    pixel[0] = lens.centre_x + scale * view[0];
    pixel[1] = height - (lens.centre_y + scale * view[1]);
    return true;
}

double render_camera_scale(const render_camera *camera, int height) {
    RENDER_ASSERT(camera && height >= 1);
    if (camera->projection == RENDER_ORTHOGRAPHIC) return height / camera->height_m;
    double sight[3];
    for (int k = 0; k < 3; k++) sight[k] = camera->target[k] - camera->eye[k];
    return height / (2 * half_tangent(camera->angle_deg) * sqrt(dot(sight, sight)));
}
