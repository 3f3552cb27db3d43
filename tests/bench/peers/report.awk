# From physics.csv and times.csv: does the physics agree, how fast is who. Prints both and writes `csv`.
# Variables: spheres ("A20k=20000;..."), csv.
#
# Agreement with ours at the steps compared, for the full law (another law is shown, not judged):
#   contacts per sphere   within 2 %; while something flows, at the first step alone, within 10 %
#   energy of motion      within 5 % at the first step; later within 20 %, for what is left of it decays
#   mean height           within 0.2 %
#   spheres out           within 3 % or 3

function off(a, b) { return b == 0 ? (a == 0 ? 0 : 1) : a > b ? a / b - 1 : 1 - a / b }

function compare(key, c, step,    ours, flows, first) {
    ours = c " clast full " step
    flows = below[ours] > 0 || flow[c]
    if (below[ours] > 0) flow[c] = 1
    first = step == early[c]
    if (!flows && off(contacts[key], contacts[ours]) > 0.02) return "contacts"
    if (flows && first && off(contacts[key], contacts[ours]) > 0.10) return "contacts"
    if (off(motion[key], motion[ours]) > (first ? 0.05 : 0.20)) return "energy of motion"
    if (off(middle[key], middle[ours]) > 0.002) return "height"
    if (off(below[key], below[ours]) > 0.03 && off(below[key], below[ours]) * below[ours] > 3) return "discharge"
    return ""
}

function median(list, n,    i, j, t, a) {
    split(list, a, " ")
    for (i = 2; i <= n; i++)
        for (j = i; j > 1 && a[j] + 0 < a[j - 1] + 0; j--) { t = a[j]; a[j] = a[j - 1]; a[j - 1] = t }
    return n % 2 ? a[(n + 1) / 2] : 0.5 * (a[n / 2] + a[n / 2 + 1])
}

BEGIN {
    FS = ","
    n = split(spheres, entry, ";")
    for (i = 1; i <= n; i++) { split(entry[i], pair, "="); count[pair[1]] = pair[2] }
}

FNR == NR {
    if (FNR == 1) next
    key = $1 " " $2 " " $3 " " $4
    contacts[key] = $5; motion[key] = $6 + $7; middle[key] = $8; below[key] = $10
    if (!($1 in early)) { early[$1] = $4; scene_order[++scenes] = $1 }
    printf "%-6s %-9s %-6s step %6d: %.4f contacts per sphere, %.4e J of motion, %.2f mm mean height, %d below\n", \
        $1, $2, $3, $4, $5, $6 + $7, 1000 * $8, $10
    if ($2 != "clast") {
        differs = $3 == "full" ? compare(key, $1, $4) : ""
        who = $1 " " $2 " " $3
        if (!(who in verdict)) verdict[who] = "agrees"
        if (differs != "" && verdict[who] == "agrees") verdict[who] = "differs in " differs " at step " $4
        if ($3 != "full") verdict[who] = "another law"
    }
    next
}

{
    run = $1 " " $2 "|" $3 "|" $4
    if (!(run in runs)) order[++rows] = $1 "," $2 "," $3 "," $4
    runs[run]++
    times[run] = times[run] " " $6
    busy_times[run] = busy_times[run] " " $6 * $8
    steps[run] = $5; skin[run] = $7
    if (!(run in share) || $8 < share[run]) share[run] = $8
}

# The same per second that the processor gave to it: what is left to compare on a busy machine.
function cpu_speed(run) { return speed(run) * median(times[run], runs[run]) / median(busy_times[run], runs[run]) }

function speed(run) { return 1e-6 * count[substr(run, 1, index(run, " ") - 1)] * steps[run] / median(times[run], runs[run]) }

END {
    for (who in verdict) if (verdict[who] ~ /^differs/) print "PHYSICS: " who " " verdict[who]
    print "scene,code,law,cores,spheres,steps,wall_s,msteps_per_s,us_per_step,msteps_per_cpu_s,ratio_of_ours,skin_m,physics,runs,least_cpu_share" >csv
    for (i = 1; i <= rows; i++) {
        split(order[i], f, ",")
        run = f[1] " " f[2] "|" f[3] "|" f[4]
        mine = speed(f[1] " clast|full|" f[4])
        who = f[1] " " f[2] " " f[3]
        printf "%s,%s,%s,%d,%d,%d,%.4f,%.4f,%.3f,%.4f,%.4f,%s,%s,%d,%s\n", f[1], f[2], f[3], f[4], count[f[1]], steps[run], \
            median(times[run], runs[run]), speed(run), count[f[1]] / speed(run), cpu_speed(run), mine / speed(run), skin[run], \
            (who in verdict ? (verdict[who] ~ /^differs/ ? "differs" : verdict[who]) : "ours"), runs[run], share[run] >csv
        if (share[run] < 0.9) busy = 1
        rate[f[1], f[2] " " f[3], f[4]] = speed(run)
        cores[f[4]] = 1
        cpu[f[1], f[2] " " f[3], f[4]] = cpu_speed(run)
        if (f[2] !~ /^clast/ && f[3] == "full" && speed(run) > best[f[1], f[4]]) {
            best[f[1], f[4]] = speed(run); best_cpu[f[1], f[4]] = cpu_speed(run); name[f[1], f[4]] = f[2]
        }
    }
    if (busy) print "BUSY: some runs had less than 0.9 of their cores (column least_cpu_share): read the ratios with care"
    printf "\nmillion sphere-steps per second; ratio: ours over the fastest peer with the same full law\n(LAMMPS has no meshes, so D and G are against LIGGGHTS); by cpu: the same by time of the processors\n"
    printf "%-6s %5s %9s %9s %9s %9s %9s | %-10s %6s %9s %9s %9s\n", "scene", "cores", "clast", "baseline", "lammps", \
        "liggghts", "simple", "fastest", "ratio", "baseline", "simple", "by cpu"
    for (s = 1; s <= scenes; s++)
        for (c = 1; c <= 64; c++) {
            if (!(c in cores)) continue
            sc = scene_order[s]
            mine = rate[sc, "clast full", c]; base = rate[sc, "clast baseline full", c]
            simple = rate[sc, "lammps simple", c]
            printf "%-6s %5d %9.2f %9.2f %9.2f %9.2f %9.2f | %-10s %6.2f %9.2f %9.2f %9.2f\n", sc, c, mine, base, \
                rate[sc, "lammps full", c], rate[sc, "liggghts full", c], simple, name[sc, c], \
                best[sc, c] ? mine / best[sc, c] : 0, best[sc, c] ? base / best[sc, c] : 0, simple ? mine / simple : 0, \
                best[sc, c] ? cpu[sc, "clast full", c] / best_cpu[sc, c] : 0
        }
}
