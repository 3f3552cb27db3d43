# sensitivity.csv, one block of rows per orifice, to tab-separated records:
#   head   D                                               row
#   row    assumption variant change half row note where   (% of the baseline of its orifice)
# An assumption is named once for its variants; note says what has no rate.
NR > 1 {
    split_csv($0, f)
    if (f[4] != orifice) {
        orifice = f[4]
        row += row ? 1.5 : 1
        printf "head\t%s\t%g\n", orifice, row
        last = ""
    }
    row++
    sub(/ us$/, " µs", f[2]); sub(/ deg$/, "°", f[2])
    sub(/^\(baseline\)$/, "baseline", f[1])
    shown = f[1] == last ? "" : f[1]
    last = f[1]
    rate = f[6] != "nan" && f[6] != "-nan"
    half = rate && f[8] > 0 && f[7] != "nan" && f[7] != "-nan" ? 100 * f[7] / f[8] : 0
    note = f[10] > 0 ? f[10] + 0 " without a rate" : ""
    printf "row\t%s\t%s\t%s\t%.3f\t%g\t%s\t%.3f\n", shown, f[2], rate ? f[9] : "NaN", half, row, note, \
        rate ? f[9] + half : 0
}
