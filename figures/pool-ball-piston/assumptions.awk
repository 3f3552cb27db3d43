# assumptions.csv to tab-separated records: assumption (once for its variants), variant, distance, P, row.
# The baseline is what all are held against and is left out.
NR > 2 {
    split_csv($0, f)
    sub(/ us /, " µs ", f[2]); sub(/ deg/, "°", f[2])
    printf "%s\t%s\t%s\t%s\t%d\n", f[1] == last ? "" : f[1], f[2], f[4], f[5], NR - 2
    last = f[1]
}
