# Rows of bench-peers.csv as one line per scene: NAME,VALUE...,RATIO with the values in the order of `codes`
# ("code/law;..."). Variables: cores, scenes (separated by commas), column (number of the value), peers (places in `codes`
# of those that the first is compared with). What is not there is 0, a bar without height; RATIO is "3.1×" or a blank.
BEGIN { FS = ","; n = split(codes, code, ";"); m = split(scenes, scene, ","); p = split(peers, peer, " ") }
NR > 1 && $4 == cores { value[$1 "," $2 "/" $3] = $column }
END {
    for (i = 1; i <= m; i++) {
        line = scene[i]; found = best = 0
        for (j = 1; j <= n; j++) {
            key = scene[i] "," code[j]
            line = line "," (key in value ? value[key] : 0)
            found += key in value
        }
        for (j = 1; j <= p; j++) {
            key = scene[i] "," code[peer[j]]
            if (key in value && value[key] + 0 > best) best = value[key] + 0
        }
        ratio = best > 0 ? sprintf("%.1f×", value[scene[i] "," code[1]] / best) : " "
        if (found) print line "," ratio
    }
}
