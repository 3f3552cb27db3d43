/* Labels around the particles. One layout serves both the drawing and the margins, so that what is
 * drawn fits into what was asked to be kept free. */
#include "render/status.h"
#include "render/text.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Sizes in pixels; everything follows from the font size. */
typedef struct layout {
    render_font *font;
    render_style plain, bold;
    render_ink ink;
    int line;   /* height of a line of text */
    int pad;    /* free border of the picture */
    int column; /* width of the right column, 0: none */
    int top, bottom;
} layout;

enum { TICKS_MAX = 12 };

typedef struct ticks {
    int count;
    double value[TICKS_MAX];
    char label[TICKS_MAX][24];
    char head[2][RENDER_TEXT_MAX * 3]; /* title and unit, in one line or two */
} ticks;

/* ---- Numbers ---- */

/* The round number (1, 2 or 5 times a power of ten) at or below value. */
static double round_below(double value) {
    double power = pow(10, floor(log10(value) + 1e-9));
    double digit = value / power;
    return power * (digit >= 5 ? 5 : digit >= 2 ? 2 : 1);
}

/* Digits after the point that a multiple of step needs. */
static int decimals_of(double step) {
    int digits = (int)ceil(-log10(step) - 1e-9);
    return digits < 0 ? 0 : digits > 9 ? 9 : digits;
}

/* A typographic minus; what rounds to zero has none. */
static void print_number(char *out, size_t size, double value, int decimals) {
    bool minus = value < 0 && -value >= 0.5 * pow(10, -decimals);
    int length = snprintf(out, size, "%s%.*f", minus ? "\xe2\x88\x92" : "", decimals, fabs(value));
    if (length < 0 || (size_t)length >= size) snprintf(out, size, "%.3g", value);
}

/* " x10^n" with superscript digits. */
static void print_power(char *out, size_t size, int exponent) {
    static const char *const DIGIT[] = {
        "\xe2\x81\xb0", "\xc2\xb9",     "\xc2\xb2",     "\xc2\xb3",     "\xe2\x81\xb4",
        "\xe2\x81\xb5", "\xe2\x81\xb6", "\xe2\x81\xb7", "\xe2\x81\xb8", "\xe2\x81\xb9"};
    char digits[16];
    snprintf(digits, sizeof digits, "%d", exponent < 0 ? -exponent : exponent);
    snprintf(out, size, "10%s", exponent < 0 ? "\xe2\x81\xbb" : "");
    for (const char *d = digits; *d; d++) {
        size_t used = strlen(out);
        snprintf(out + used, size - used, "%s", DIGIT[*d - '0']);
    }
}

/* Large and small numbers share a power of a thousand, named beside the unit. */
static int shared_exponent(double largest) {
    if (largest >= 1e-2 && largest < 1e5) return 0;
    return 3 * (int)floor(log10(largest) / 3 + 1e-9);
}

/* "speed (m/s)" above the bar; on two lines if that makes the column wide. */
static void print_heads(const render_overlay *o, int exponent, ticks *t) {
    char power[40] = "", unit[RENDER_TEXT_MAX + 48];
    if (exponent != 0) print_power(power, sizeof power, exponent);
    snprintf(unit, sizeof unit, "%s%s%s", power, *power && *o->bar_unit ? " " : "", o->bar_unit);
    bool both = *o->bar_title && *unit;
    bool one_line = strlen(o->bar_title) + strlen(unit) <= 14; /* bytes; near enough */
    if (both && one_line) {
        snprintf(t->head[0], sizeof t->head[0], "%s (%s)", o->bar_title, unit);
    } else {
        snprintf(t->head[0], sizeof t->head[0], "%s", *o->bar_title ? o->bar_title : unit);
        if (both) snprintf(t->head[1], sizeof t->head[1], "(%s)", unit);
    }
}

static void make_ticks(const render_overlay *o, ticks *t) {
    *t = (ticks){.count = 0};
    int exponent = shared_exponent(fmax(fabs(o->bar_low), fabs(o->bar_high)));
    double unit = pow(10, exponent), low = o->bar_low / unit, high = o->bar_high / unit;
    double step = round_below((high - low) / 4);
    int decimals = decimals_of(step);
    for (double n = ceil(low / step - 1e-9); n * step <= high + 1e-9 * step; n++) {
        if (t->count == TICKS_MAX) break;
        t->value[t->count] = n * step * unit;
        print_number(t->label[t->count++], sizeof t->label[0], n * step, decimals);
    }
    print_heads(o, exponent, t);
}

static void print_length(char *out, size_t size, double metres) {
    double value = metres < 1e-3 ? metres * 1e6 : metres < 0.1 ? metres * 1e3 : metres;
    const char *unit = metres < 1e-3 ? "\xc2\xb5m" : metres < 0.1 ? "mm" : "m";
    snprintf(out, size, "%.6g %s", value, unit);
}

/* ---- Layout ---- */

static render_status widen(const layout *l, render_style style, const char *text, int extra,
                           int *width) {
    int wide = 0;
    render_status status = render_text_measure(l->font, style, text, &wide);
    if (wide + extra > *width) *width = wide + extra;
    return status;
}

static int bar_thickness(const layout *l) {
    return l->line;
}

static int label_start(const layout *l) { /* of tick and legend labels, from the column's left */
    return bar_thickness(l) + l->line / 2;
}

static render_status measure_column(layout *l, const render_overlay *o) {
    render_status status = RENDER_OK;
    l->column = 0;
    if (o->bar_shown) {
        ticks t;
        make_ticks(o, &t);
        for (int i = 0; i < 2 && status == RENDER_OK; i++)
            status = widen(l, l->plain, t.head[i], 0, &l->column);
        for (int i = 0; i < t.count && status == RENDER_OK; i++)
            status = widen(l, l->plain, t.label[i], label_start(l), &l->column);
    }
    if (o->legend_count > 0 && status == RENDER_OK)
        status = widen(l, l->plain, o->legend_title, 0, &l->column);
    for (int i = 0; i < o->legend_count && status == RENDER_OK; i++)
        status = widen(l, l->plain, o->legend[i].label, label_start(l), &l->column);
    return status;
}

static render_status check_overlay(const render_overlay *o) {
    if (o->legend_count < 0 || o->legend_count > RENDER_LEGEND_MAX || o->notes_count < 0 ||
        o->notes_count > RENDER_NOTES_MAX)
        return render_fail(RENDER_ERR_ARGUMENT,
                           "overlay: %d legend entries and %d notes, at most "
                           "%d and %d",
                           o->legend_count, o->notes_count, RENDER_LEGEND_MAX, RENDER_NOTES_MAX);
    bool finite = isfinite(o->bar_low) && isfinite(o->bar_high);
    if (o->bar_shown && !(finite && o->bar_low < o->bar_high))
        return render_fail(RENDER_ERR_ARGUMENT, "overlay: colour bar from %g to %g", o->bar_low,
                           o->bar_high);
    if (!isfinite(o->time_s) || !isfinite(o->text_px) || o->text_px < 0 || o->text_px > 500)
        return render_fail(RENDER_ERR_ARGUMENT, "overlay: time %g s, text of %g px", o->time_s,
                           o->text_px);
    if (o->time_decimals < 0 || o->time_decimals > 9)
        return render_fail(RENDER_ERR_ARGUMENT, "overlay: time with %d decimals, expected 0 to 9",
                           o->time_decimals);
    if (!(o->scale_px_per_m >= 0) || !(o->scale_m >= 0) || !isfinite(o->scale_px_per_m) ||
        !isfinite(o->scale_m))
        return render_fail(RENDER_ERR_ARGUMENT, "overlay: scale bar of %g m at %g px/m", o->scale_m,
                           o->scale_px_per_m);
    for (int i = 0; i < o->notes_count; i++)
        if (!(fabs(o->notes[i].x) < 1e6 && fabs(o->notes[i].y) < 1e6))
            return render_fail(RENDER_ERR_ARGUMENT, "overlay: note %d lies at %g, %g", i,
                               o->notes[i].x, o->notes[i].y);
    return RENDER_OK;
}

static render_status make_layout(layout *l, render_font *font, const render_overlay *o, int width,
                                 int height) {
    render_status status = check_overlay(o);
    if (status != RENDER_OK) return status;
    double side = fmin(height, 0.7 * width); /* a tall picture has little room beside it */
    double px = o->text_px > 0 ? fmax(o->text_px, 4) : fmax(11, side / 40);
    render_rgb dark = {30, 32, 36}, light = {244, 244, 246}, white = {255, 255, 255};
    *l = (layout){.font = font,
                  .plain = {(int)(px + 0.5), false},
                  .bold = {(int)(1.1 * px + 0.5), true},
                  .ink = {o->dark_background ? light : dark, o->dark_background ? dark : white},
                  .line = (int)(px + 0.5),
                  .pad = (int)(1.2 * px + 0.5)};
    if (*o->title || o->time_shown) l->top = 2 * l->pad + l->line;
    if (o->scale_px_per_m > 0) l->bottom = l->pad + 2 * l->line + l->pad / 2;
    return measure_column(l, o);
}

render_status render_overlay_margins(render_font *font, const render_overlay *overlay, int width,
                                     int height, render_margins *margins) {
    RENDER_ASSERT(font && overlay && margins && width >= 1 && height >= 1);
    layout l;
    render_status status = make_layout(&l, font, overlay, width, height);
    if (status != RENDER_OK) return status;
    int right = l.column > 0 ? l.column + 2 * l.pad : l.pad;
    *margins = (render_margins){.left = l.pad,
                                .right = right,
                                .top = l.top > l.pad ? l.top : l.pad,
                                .bottom = l.bottom > l.pad ? l.bottom : l.pad};
    return RENDER_OK;
}

/* ---- Drawing ---- */

/* A rectangle of which the old pixels keep `kept` of 8 parts. */
static void paint(render_image *image, int x, int y, int width, int height, render_rgb c,
                  int kept) {
    for (int j = y < 0 ? 0 : y; j < y + height && j < image->height; j++)
        for (int i = x < 0 ? 0 : x; i < x + width && i < image->width; i++) {
            uint8_t *p = image->rgb + 3 * ((size_t)j * (size_t)image->width + (size_t)i);
            p[0] = (uint8_t)((p[0] * kept + c.r * (8 - kept)) / 8);
            p[1] = (uint8_t)((p[1] * kept + c.g * (8 - kept)) / 8);
            p[2] = (uint8_t)((p[2] * kept + c.b * (8 - kept)) / 8);
        }
}

static void fill(render_image *image, int x, int y, int width, int height, render_rgb c) {
    paint(image, x, y, width, height, c, 0);
}

static void veil(render_image *image, int x, int y, int width, int height, render_rgb c) {
    paint(image, x, y, width, height, c, 2);
}

static render_status put(const layout *l, render_style style, const char *text, int x, int y,
                         render_image *image) {
    return render_text_draw(l->font, style, text, x, y, l->ink, image);
}

static render_status draw_head(const layout *l, const render_overlay *o, render_image *image) {
    int base = l->pad + l->line * 4 / 5;
    render_status status = put(l, l->bold, o->title, l->pad, base, image);
    if (status != RENDER_OK || !o->time_shown) return status;
    char number[80], text[96];
    print_number(number, sizeof number, o->time_s, o->time_decimals);
    snprintf(text, sizeof text, "t = %s s", number);
    int width = 0;
    status = render_text_measure(l->font, l->plain, text, &width);
    if (status != RENDER_OK) return status;
    return put(l, l->plain, text, image->width - l->pad - width, base, image);
}

static render_status draw_scale(const layout *l, const render_overlay *o, render_image *image) {
    if (!(o->scale_px_per_m > 0)) return RENDER_OK;
    double length =
        o->scale_m > 0 ? o->scale_m : round_below(image->width / 6.0 / o->scale_px_per_m);
    double exact = length * o->scale_px_per_m;
    if (!(exact <= image->width))
        return render_fail(RENDER_ERR_ARGUMENT, "overlay: a scale bar of %g m is %g px long",
                           length, exact);
    int px = (int)(exact + 0.5), thick = l->line / 6 < 2 ? 2 : l->line / 6;
    int x = l->pad, y = image->height - l->pad - thick, tick = l->line / 3;
    fill(image, x - 1, y - 1, px + 2, thick + 2, l->ink.halo);
    fill(image, x, y, px, thick, l->ink.ink);
    fill(image, x, y - tick, thick, tick, l->ink.ink);
    fill(image, x + px - thick, y - tick, thick, tick, l->ink.ink);
    char text[48];
    int width = 0;
    print_length(text, sizeof text, length);
    render_status status = render_text_measure(l->font, l->plain, text, &width);
    if (status != RENDER_OK) return status;
    int left = x + (px - width) / 2;
    return put(l, l->plain, text, left < x ? x : left, y - l->line / 2, image);
}

/* A framed rectangle; at(row) would be a callback for one use, so the map comes in directly. */
static void draw_ramp(const layout *l, const render_overlay *o, int x, int y, int height,
                      render_image *image) {
    int wide = bar_thickness(l);
    fill(image, x - 1, y - 1, wide + 2, height + 2, l->ink.ink);
    for (int row = 0; row < height; row++)
        fill(image, x, y + row, wide, 1,
             render_map_at(o->bar_map, (height - 1 - row) / (double)(height - 1)));
}

static int legend_height(const layout *l, const render_overlay *o) {
    if (o->legend_count == 0) return 0;
    int lines = o->legend_count + (*o->legend_title ? 1 : 0);
    return lines * l->line * 8 / 5;
}

/* Title and unit above, ticks to the right. Returns where it ends in *y. */
static render_status draw_bar(const layout *l, const render_overlay *o, int x, int *y, int height,
                              render_image *image) {
    ticks t;
    make_ticks(o, &t);
    render_status status = RENDER_OK;
    for (int i = 0; i < 2 && status == RENDER_OK; i++) {
        if (!*t.head[i]) continue;
        status = put(l, l->plain, t.head[i], x, *y + l->line, image);
        *y += l->line * 5 / 4;
    }
    *y += l->line * 3 / 4;
    draw_ramp(l, o, x, *y, height, image);
    for (int i = 0; i < t.count && status == RENDER_OK; i++) {
        double share = (t.value[i] - o->bar_low) / (o->bar_high - o->bar_low);
        int at = *y + (int)((height - 1) * (1 - share) + 0.5);
        fill(image, x + bar_thickness(l) + 1, at, l->line / 4, 1, l->ink.ink);
        status = put(l, l->plain, t.label[i], x + label_start(l), at + l->line * 3 / 8, image);
    }
    *y += height + l->line * 2;
    return status;
}

static render_status draw_legend(const layout *l, const render_overlay *o, int x, int y,
                                 render_image *image) {
    render_status status = RENDER_OK;
    int step = l->line * 8 / 5;
    if (*o->legend_title) {
        status = put(l, l->plain, o->legend_title, x, y + l->line, image);
        y += step;
    }
    for (int i = 0; i < o->legend_count && status == RENDER_OK; i++, y += step) {
        fill(image, x - 1, y + l->line / 6 - 1, l->line + 2, l->line + 2, l->ink.ink);
        fill(image, x, y + l->line / 6, l->line, l->line, o->legend[i].colour);
        status = put(l, l->plain, o->legend[i].label, x + label_start(l), y + l->line, image);
    }
    return status;
}

/* Colour bar and legend, one above the other, in the middle of the right side. */
static render_status draw_column(const layout *l, const render_overlay *o, render_image *image) {
    int x = image->width - l->pad - l->column, legend = legend_height(l, o);
    int above = l->top > l->pad ? l->top : l->pad, below = l->pad;
    int room = image->height - above - below, bar = 0, all = legend;
    if (o->bar_shown) {
        int head = 2 * l->line * 5 / 4 + l->line;
        bar = image->height / 2;
        if (bar > room - head - legend - 2 * l->line) bar = room - head - legend - 2 * l->line;
        if (bar < 2 * l->line) bar = 2 * l->line;
        all += head + bar + (legend > 0 ? 2 * l->line : 0);
    }
    int y = above + (room - all) / 2;
    if (y < above) y = above;
    render_status status = RENDER_OK;
    if (o->bar_shown) status = draw_bar(l, o, x, &y, bar, image);
    if (status == RENDER_OK && o->legend_count > 0) status = draw_legend(l, o, x, y, image);
    return status;
}

/* A note may lie over particles, where a halo alone is not enough: it gets a translucent plate. */
static render_status draw_note(const layout *l, const render_note *note, render_image *image) {
    int x = (int)floor(note->x + 0.5), y = (int)floor(note->y + 0.5), width = 0;
    render_status status = render_text_measure(l->font, l->plain, note->text, &width);
    if (status != RENDER_OK || width == 0) return status;
    int margin = l->line / 3;
    veil(image, x - margin, y - l->line, width + 2 * margin, l->line * 11 / 8, l->ink.halo);
    return put(l, l->plain, note->text, x, y, image);
}

render_status render_overlay_draw(render_font *font, const render_overlay *overlay,
                                  render_image *image) {
    RENDER_ASSERT(font && overlay && image);
    if (!image->rgb) return render_fail(RENDER_ERR_ARGUMENT, "overlay: the image is empty");
    layout l;
    render_status status = make_layout(&l, font, overlay, image->width, image->height);
    if (status == RENDER_OK) status = draw_head(&l, overlay, image);
    if (status == RENDER_OK) status = draw_scale(&l, overlay, image);
    if (status == RENDER_OK) status = draw_column(&l, overlay, image);
    for (int i = 0; i < overlay->notes_count && status == RENDER_OK; i++)
        status = draw_note(&l, &overlay->notes[i], image);
    return status;
}

void render_overlay_bands(render_overlay *overlay, double fastest) {
    RENDER_ASSERT(overlay);
    static const char *const SHARE[3] = {"< 30 %", "30\342\200\22370 %", "> 70 %"};
    overlay->legend_count = 3;
    snprintf(overlay->legend_title, sizeof overlay->legend_title, "share of %.3g m/s", fastest);
    for (int i = 0; i < 3; i++) { /* fastest on top, as on a colour bar */
        overlay->legend[i].colour = RENDER_BAND_TINT[2 - i];
        snprintf(overlay->legend[i].label, RENDER_TEXT_MAX, "%s", SHARE[2 - i]);
    }
}
