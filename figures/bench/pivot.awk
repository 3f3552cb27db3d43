# Rows of bench-peers.csv as one line per scene: NAME VALUE... in the order of `codes` ("code/law;..."). Variables: cores,
# scenes (separated by commas), column (number of the value). What is not there is nan.
BEGIN { FS = ","; n = split(codes, code, ";"); m = split(scenes, scene, ",") }
NR > 1 && $4 == cores { value[$1 "," $2 "/" $3] = $column }
END {
    for (i = 1; i <= m; i++) {
        line = scene[i]; found = 0
        for (j = 1; j <= n; j++) {
            key = scene[i] "," code[j]
            line = line "," (key in value ? value[key] : "nan")
            found += key in value
        }
        if (found) print line
    }
}
