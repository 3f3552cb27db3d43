# page.txt of a study to HTML. Each line is a word and what it applies to; README.md lists the words.
# Variables: study, out (folder of the pages), scripts (folder of the gnuplot scripts).

function escape(s) {
    gsub(/&/, "\\&amp;", s); gsub(/</, "\\&lt;", s); gsub(/>/, "\\&gt;", s)
    return s
}

function exists(file,    line, found) {
    found = (getline line < file) >= 0
    close(file)
    return found
}

# "47.3 ± 2.1": two digits of the interval decide, as in the verdicts that are printed. bare: without the number of
# runs where there is no interval.
function with_half(mean, half, n, bare,    decimals) {
    if (mean == "") return "none"
    if (half == "") return minus(sprintf("%.4g", mean)) (bare || n == 0 ? "" : " (n = " n ")")
    decimals = half > 0 ? 1 - floor(log(half) / log(10) + 1e-9) : 3
    if (decimals < 0) decimals = 0
    return minus(sprintf("%." decimals "f ± %." decimals "f", mean, half))
}

function floor(x,    i) { i = int(x); return i > x ? i - 1 : i }
function minus(s) { sub(/^-/, "−", s); return s }
function dash(s) { return s == "" || s == "nan" ? "–" : minus(s) }

# ---- what was made -------------------------------------------------------------------------------------

function read_about(    line, at) {
    while ((getline line < (out "/" study "/data/about.txt")) > 0) {
        at = index(line, "=")
        about[substr(line, 1, at - 1)] = substr(line, at + 1)
    }
}

function read_verdicts(    line, f, i, n, name) {
    while ((getline line < (out "/" study "/data/verdicts.csv")) > 0) {
        n = split_csv(line, f)
        if (!columns) { for (i = 1; i <= n; i++) name[i] = f[i]; columns = n; continue }
        quantity[++verdicts] = f[1]
        for (i = 2; i <= n; i++) verdict[f[1], name[i]] = f[i]
        if (verdict[f[1], "verdict"] != "not comparable") counted++
        if (verdict[f[1], "verdict"] == "met") met++
        if (verdict[f[1], "verdict"] == "open") undecided++
    }
}

function ours(q, bare) { return with_half(verdict[q, "ours"], verdict[q, "half"], verdict[q, "n"], bare) }

function unit_of(q) {
    if (verdict[q, "unit"] == "") return ""
    if (verdict[q, "unit"] == "g/cm2") return " g/cm²"
    if (verdict[q, "unit"] == "1/cm") return " cm⁻¹"
    return " " verdict[q, "unit"]
}

# {about size}, {ours kd}, {experiment kd}, {thesis kd}, {met}, {counted}, {open} in running text.
function fill(s,    word, what, value, inside) {
    s = escape(s)
    while (match(s, /\{[^}]*\}/)) {
        inside = substr(s, RSTART + 1, RLENGTH - 2)
        word = inside; sub(/ .*/, "", word)
        what = inside; sub(/^[^ ]* ?/, "", what); gsub(/&gt;/, ">", what)
        if (word == "about") { value = dash(about[what]); sub(/ us$/, " µs", value) }
        else if (word == "met") value = met + 0
        else if (word == "counted") value = counted + 0
        else if (word == "open") value = undecided + 0
        else if (word == "ours") value = ours(what, 1) unit_of(what)
        else value = dash(verdict[what, word]) unit_of(what)
        s = substr(s, 1, RSTART - 1) escape(value) substr(s, RSTART + RLENGTH)
    }
    return s
}

# ---- pieces ----------------------------------------------------------------------------------------------

function open_grid() { if (!grid) print "<div class=\"grid\">"; grid = 1 }
function close_all() {
    if (grid) print "</div>"
    if (list) print "</ul>"
    if (tiles) print "</div>"
    grid = list = tiles = 0
}

function made_with() {
    return "size " about["size"] ", " about["replicates"] ", hash <code>" about["hash"] "</code>"
}

# A line "# key: value" of a gnuplot script.
function from_script(file, key,    line, value) {
    while ((getline line < file) > 0)
        if (index(line, "# " key ": ") == 1) value = substr(line, length(key) + 5)
    close(file)
    return value
}

function width_of(file,    line, value) {
    while ((getline line < file) > 0)
        if (line ~ /^width = /) { value = line; sub(/^width = /, "", value); break }
    close(file)
    return value + 0
}

function missing(class, title, why) {
    printf "<figure class=\"%s missing\"><p>%s: not made at this size%s.</p></figure>\n", class, title, why
}

function figure(name,    script, base, title, class) {
    script = scripts "/" name ".gp"
    base = study "/" name
    title = escape(from_script(script, "title"))
    class = width_of(script) > 13 ? "wide" : "half"
    open_grid()
    if (!exists(out "/" base ".svg")) { missing(class, title, ""); return }
    figures++
    printf "<figure class=\"%s\" id=\"%s-%s\">\n", class, study, name
    printf "<a href=\"%s.png\"><img src=\"%s.svg\" alt=\"%s\"></a>\n", base, base, title
    printf "<figcaption><b>Figure %d. %s.</b> %s <span class=\"fine\">Counterpart: %s. Made with %s. <a href=\"%s.png\">PNG</a> <a href=\"%s.svg\">SVG</a></span></figcaption>\n</figure>\n", \
        figures, title, escape(from_script(script, "caption")), escape(from_script(script, "counterpart")), made_with(), base, base
}

# FILE | half, third or wide | title | counterpart | caption
function picture(rest, movie,    part, file, class) {
    split(rest, part, / \| /)
    file = study "/frames/" part[1]
    class = part[2] " picture"
    open_grid()
    if (!exists(out "/" file)) { missing(class, escape(part[3]), ""); return }
    figures++
    printf "<figure class=\"%s\">\n", class
    if (movie) printf "<video controls loop muted playsinline preload=\"metadata\" src=\"%s\"></video>\n", file
    else printf "<a href=\"%s\"><img src=\"%s\" alt=\"%s\"></a>\n", file, file, escape(part[3])
    printf "<figcaption><b>Figure %d. %s.</b> %s <span class=\"fine\">Counterpart: %s. Made with %s.</span></figcaption>\n</figure>\n", \
        figures, escape(part[3]), escape(part[5]), escape(part[4]), made_with()
}

# QUANTITY | label
function headline(rest,    part, q, v) {
    split(rest, part, / \| /)
    q = part[1]
    if (!((q, "verdict") in verdict)) return
    if (!tiles) print "<div class=\"tiles\">"
    tiles = 1
    v = verdict[q, "verdict"]
    printf "<div class=\"tile\"><p class=\"label\">%s</p><p class=\"number\">%s</p><p class=\"beside\">experiment %s<br>thesis simulation %s</p><p class=\"says %s\">%s</p></div>\n", \
        escape(part[2]) (unit_of(q) != "" ? " (" substr(unit_of(q), 2) ")" : ""), ours(q, 1), dash(verdict[q, "experiment"]), dash(verdict[q, "thesis"]), class_of(v), v
}

function class_of(v) { return v == "met" || v == "missed" || v == "open" ? v : "none" }

function tolerance_of(q,    t) {
    t = verdict[q, "tolerance"]
    if (t ~ /^[0-9]/) return "± " t
    sub(/^equal /, "equal within ", t)
    return t == "" ? "–" : t
}

function verdict_rows(    i, q, v) {
    if (!verdicts) { print "<p class=\"missing\">No verdicts at this size.</p>"; return }
    print "<table class=\"verdicts\"><thead><tr><th>quantity</th><th>unit</th><th>Clast (95 % interval)</th><th>experiment</th><th>thesis</th><th>tolerance</th><th>verdict</th><th>source</th></tr></thead><tbody>"
    for (i = 1; i <= verdicts; i++) {
        q = quantity[i]; v = verdict[q, "verdict"]
        printf "<tr class=\"%s\"><td>%s</td><td>%s</td><td class=\"n strong\">%s</td><td class=\"n\">%s</td><td class=\"n\">%s</td><td class=\"n\">%s</td><td><span class=\"says %s\">%s</span></td><td class=\"fine\">%s</td></tr>\n", \
            class_of(v), escape(q), escape(unit_of(q)), ours(q), dash(verdict[q, "experiment"]), dash(verdict[q, "thesis"]), escape(tolerance_of(q)), class_of(v), v, escape(verdict[q, "source"])
    }
    printf "</tbody><tfoot><tr><td colspan=\"8\">%s: %d of %d met%s</td></tr></tfoot></table>\n", study, met, counted, undecided ? ", " undecided " open (too few runs to say)" : ""
}

function sensitivity_rows(    line, f, n, i, at, last, shown, orifice) {
    if (!exists(out "/" study "/data/sensitivity.csv")) {
        print "<p class=\"missing\">The sensitivity table is not made at this size.</p>"
        return
    }
    print "<table class=\"sensitivity\"><thead><tr><th>assumption</th><th>variant</th><th>runs with a rate</th><th>without</th><th>rate (g/s)</th><th>change</th><th>solid fraction at rest</th></tr></thead><tbody>"
    while ((getline line < (out "/" study "/data/sensitivity.csv")) > 0) {
        n = split_csv(line, f)
        if (!last && !("assumption" in at)) { for (i = 1; i <= n; i++) at[f[i]] = i; continue }
        for (i = 1; i <= n; i++) if (f[i] == "nan" || f[i] == "-nan") f[i] = ""
        if (f[4] != orifice) {
            orifice = f[4]; last = ""
            printf "<tr class=\"orifice\"><th colspan=\"7\">D = %s cm</th></tr>\n", orifice
        }
        shown = f[1] == last ? "" : f[1]; last = f[1]
        sub(/^\(baseline\)$/, "baseline", shown); sub(/ us$/, " µs", f[2]); sub(/ deg$/, "°", f[2])
        printf "<tr%s><td>%s</td><td>%s</td><td class=\"n\">%s</td><td class=\"n\">%s</td><td class=\"n strong\">%s</td><td class=\"n\">%s</td><td class=\"n\">%s</td></tr>\n", \
            shown != "" ? " class=\"first\"" : "", escape(shown), escape(f[2]), f[at["n"]], \
            "blocked" in at ? f[at["blocked"]] : "–", with_half(f[at["q_mean"]], f[at["q_half"]], f[at["n"]]), \
            f[at["change_percent"]] == "" ? "–" : minus(sprintf("%+.1f %%", f[at["change_percent"]])), \
            "rest_mean" in at ? with_half(f[at["rest_mean"]], f[at["rest_half"]], f[at["n"]]) : "–"
    }
    print "</tbody></table>"
}

# FILE | COLUMN=VALUE | heading; heading; ... | words when there are none: rows of data/FILE.csv of which that column has
# that value, without the column.
function table(rest,    part, head, line, f, i, n, at, key, value, rows, last) {
    split(rest, part, / \| /)
    key = value = part[2]
    sub(/=.*/, "", key); sub(/^[^=]*=/, "", value)
    while ((getline line < (out "/" study "/data/" part[1] ".csv")) > 0) {
        n = split_csv(line, f)
        if (!at) { for (i = 1; i <= n; i++) if (f[i] == key) at = i; continue }
        if (f[at] != value) continue
        if (!rows++) {
            printf "<table><thead><tr>"
            split(part[3], head, /; /)
            for (i = 1; i in head; i++) printf "<th>%s</th>", escape(head[i])
            print "</tr></thead><tbody>"
        }
        printf "<tr%s>", f[at + 1] == last ? "" : " class=\"first\""
        for (i = 1; i <= n; i++) {
            if (i == at) continue
            sub(/ us$/, " µs", f[i])
            printf "<td>%s</td>", i == at + 1 && f[i] == last ? "" : escape(dash(f[i]))
        }
        print "</tr>"
        last = f[at + 1]
    }
    close(out "/" study "/data/" part[1] ".csv")
    if (rows) print "</tbody></table>"
    else printf "<p class=\"missing\">%s</p>\n", fill(part[4])
}

# Every table of the study, whatever its name.
function tables(    list, file, links, name) {
    list = "ls '" out "/" study "/data/' 2>/dev/null"
    while ((list | getline name) > 0) {
        if (name !~ /\.csv$/) continue
        file = study "/data/" name
        links = links " <a href=\"" file "\">" name "</a>"
    }
    close(list)
    return links
}

function facts(    keys, n, i, key) {
    n = split("size replicates particles spheres_per_particle step worst_residual wall_s engine hash", keys, " ")
    print "<table class=\"facts\"><tbody>"
    for (i = 1; i <= n; i++) {
        key = keys[i]
        if (!(key in about)) continue
        gsub(/_/, " ", key); sub(/wall s/, "wall time (s)", key); sub(/worst residual/, "largest energy residual", key)
        printf "<tr><th>%s</th><td>%s</td></tr>\n", key, escape(about[keys[i]])
    }
    printf "<tr><th>data</th><td>%s</td></tr>\n</tbody></table>\n", tables()
}

# ---- the page --------------------------------------------------------------------------------------------

BEGIN { read_about(); read_verdicts(); printf "<main id=\"%s\">\n", study }
/^#/ || /^$/ { next }
{
    word = $1
    rest = $0; sub(/^[^ ]+ */, "", rest)
    if (word !~ /^(figure|picture|movie)$/ && grid) close_all()
    if (word != "item" && list) close_all()
    if (word != "headline" && tiles) close_all()
}
word == "title"       { printf "<h1>%s</h1>\n", escape(rest); next }
word == "source"      { printf "<p class=\"source\">%s</p>\n", fill(rest); next }
word == "lead"        { printf "<p class=\"lead\">%s</p>\n", fill(rest); next }
word == "text"        { printf "<p>%s</p>\n", fill(rest); next }
word == "section"     { printf "<h2>%s</h2>\n", escape(rest); next }
word == "headline"    { headline(rest); next }
word == "verdicts"    { verdict_rows(); next }
word == "sensitivity" { sensitivity_rows(); next }
word == "table"       { table(rest); next }
word == "facts"       { facts(); next }
word == "figure"      { figure(rest); next }
word == "picture"     { picture(rest, 0); next }
word == "movie"       { picture(rest, 1); next }
word == "item"        { if (!list) print "<ul>"; list = 1; printf "<li>%s</li>\n", fill(rest); next }
{ printf "%s:%d: unknown word '%s'\n", FILENAME, FNR, word > "/dev/stderr"; bad = 1; exit 1 }
END { if (bad) exit 1; close_all(); print "</main>" }
