# Mean and 95 % interval of a column over replicates, by time. Variables: fill, orifice, column; hold = 1
# keeps the last value of a run that has ended (mass discharged), hold = 0 leaves it out.
# Writes time,mean,low,high,n with a record per time; without an interval (n = 1) low = high = mean.
function student(df) { return df in t975 ? t975[df] : 1.96 + 2.5 / df }
BEGIN {
    FS = ","
    split("12.706 4.303 3.182 2.776 2.571 2.447 2.365 2.306 2.262 2.228 2.201 2.179 2.160 2.145 2.131 2.120 2.110 2.101 2.093", q, " ")
    for (i in q) t975[i + 0] = q[i]
}
NR > 1 && $1 == fill && $2 == orifice {
    if (!($4 in seen)) { seen[$4] = 1; time[++times] = $4 }
    if (!($3 in run)) { run[$3] = 1; runs++ }
    value[$3, $4] = $column; has[$3, $4] = 1
}
END {
    for (i = 2; i <= times; i++)               # times come sorted by run: insertion sort of the few strays
        for (j = i; j > 1 && time[j] + 0 < time[j - 1] + 0; j--) { t = time[j]; time[j] = time[j - 1]; time[j - 1] = t }
    for (i = 1; i <= times; i++) {
        n = sum = square = 0
        for (r in run) {
            if ((r, time[i]) in has) last[r] = value[r, time[i]]
            else if (!hold) continue
            if (!(r in last)) continue
            n++; x[n] = last[r]; sum += x[n]
        }
        if (n == 0 || (n < runs && !hold && n < (runs + 1) / 2)) continue
        mean = sum / n
        for (k = 1; k <= n; k++) square += (x[k] - mean) ^ 2
        half = n > 1 ? student(n - 1) * sqrt(square / (n - 1) / n) : 0
        printf "%s,%.6g,%.6g,%.6g,%d\n", time[i], mean, mean - half, mean + half, n
    }
}
