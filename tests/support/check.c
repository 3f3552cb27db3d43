#include "tests/support/check.h"

#include <unistd.h>

#include "engine/clast.h"

void check_near(const char *file, int line, const char *what, double got, double want,
                double tolerance) {
    if (fabs(got - want) <= tolerance) return;
    print_error("%s = %.17g, want %.17g +- %.3g (off by %.3g)\n", what, got, want, tolerance,
                got - want);
    _fail(file, line);
}

void check_below(const char *file, int line, const char *what, double a, double b) {
    if (a < b) return;
    print_error("%s: %.9g is not below %.9g\n", what, a, b);
    _fail(file, line);
}

double order_of(double coarse_error, double fine_error, double refined) {
    return log(fabs(coarse_error) / fabs(fine_error)) / log(refined);
}

double roll(dice *d, double low, double high) {
    return low + (high - low) * clast_random(d->seed, 77, d->count++);
}

scratch_name scratch_file(const char *what) {
    scratch_name name;
    const char *folder = getenv("TMPDIR");
    int length = snprintf(name.text, sizeof name.text, "%s/%ld-%s",
                          folder && folder[0] ? folder : "/tmp", (long)getpid(), what);
    assert_true(length > 0 && (size_t)length < sizeof name.text);
    return name;
}
