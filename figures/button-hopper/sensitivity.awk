# sensitivity.csv to assumption, variant, change (%), half width (%), row; separated by tabs, so that texts may
# hold commas. An assumption is named once for all of its variants.
function split_csv(line, f,    n, c, quoted, i) {
    n = 1; f[1] = ""
    for (i = 1; i <= length(line); i++) {
        c = substr(line, i, 1)
        if (c == "\"") quoted = !quoted
        else if (c == "," && !quoted) f[++n] = ""
        else f[n] = f[n] c
    }
    return n
}
NR > 1 {
    split_csv($0, f)
    sub(/ us$/, " µs", f[2]); sub(/ deg$/, "°", f[2])
    if (f[10] > 0) f[2] = f[2] " [" f[10] " blocked]"
    sub(/^\(baseline\)$/, "baseline", f[1])
    shown = f[1] == last ? "" : f[1]
    last = f[1]
    half = f[8] > 0 && f[7] != "nan" ? 100 * f[7] / f[8] : 0
    printf "%s\t%s\t%s\t%.3f\t%d\n", shown, f[2], f[9], half, NR - 1
}
