# profile.csv: direction (degrees), reach of the spheres minus reach of the ellipse (mm).
$1 == "outline" { x[++n] = $2; z[n] = $3 }
$1 == "sphere"  { cx[++m] = $2; cr[m] = $4 }
END {
    for (i = 1; i <= n; i++) {
        r = sqrt(x[i] * x[i] + z[i] * z[i]); ux = x[i] / r; reach = 0
        for (k = 1; k <= m; k++) {
            along = cx[k] * ux
            inside = cr[k] * cr[k] - cx[k] * cx[k] + along * along
            if (inside >= 0 && along + sqrt(inside) > reach) reach = along + sqrt(inside)
        }
        a = atan2(z[i], x[i]) * 57.29577951308232
        if (a < 0) a += 360
        if (i == n) a = 360
        printf "%.4f,%.6f\n", a, 10 * (reach - r)
    }
}
