# needs.csv to tab-separated rows for one observable:
#   awk -v scene=heap -v what='angle of repose' -f needs.awk needs.csv
#   place  cost  cost_half  size  low  high  told  signed  signed_low  signed_high  lost  name
# place counts the switches as the key of needs.gp has them; size, low and high are |change| in % (low is no less
# than a tenth of size, for a logarithmic axis); told is 1 where the interval leaves out zero.
BEGIN {
    FS = ","; OFS = "\t"
    n = split("tangential history|rotation|friction|rolling friction|contact damping|third dimension|Hertz|double precision|" \
              "15 spheres per body|3 spheres per body|1 sphere per body", name, "|")
    for (i = 1; i <= n; i++) place[name[i]] = i
}
function size(x) { return x < 0 ? -x : x }
FNR > 1 && $1 == scene && $2 == what {
    label = $3
    if (label == "spheres per body") { label = $4; sub(/ in place of .*/, "", label) }
    if (!(label in place)) { print "needs.awk: no place for " label > "/dev/stderr"; exit 1 }
    if ($11 > 0 || $5 == "nan" || $5 == "-nan") {
        print place[label], $8, $9, "NaN", "NaN", "NaN", 0, "NaN", "NaN", "NaN", $11, label
        next
    }
    told = $6 > 0 || $7 < 0
    high = size($6) > size($7) ? size($6) : size($7)
    low = size($6) > size($7) ? size($7) : size($6)
    if (low < 0.1 * size($5)) low = 0.1 * size($5)
    print place[label], $8, ($9 == "nan" || $9 == "-nan" ? 0 : $9), 100 * size($5), 100 * low, 100 * high, told, 100 * $5, 100 * $6, 100 * $7, $11, label
}
