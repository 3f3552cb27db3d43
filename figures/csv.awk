# One record of a CSV file into f[1] to f[n]; a field that holds a comma or a quote is quoted, "" for a quote.
function split_csv(line, f,    n, c, quoted, i) {
    split("", f)
    n = 1; f[1] = ""
    for (i = 1; i <= length(line); i++) {
        c = substr(line, i, 1)
        if (c == "\"") {
            if (quoted && substr(line, i + 1, 1) == "\"") { f[n] = f[n] c; i++ }
            else quoted = !quoted
        }
        else if (c == "," && !quoted) f[++n] = ""
        else f[n] = f[n] c
    }
    return n
}
