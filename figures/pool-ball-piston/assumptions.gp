# title: What each assumption does
# counterpart: none, the source has no such study
# needs: assumptions.csv
# caption: Distance of the mean track of the replicates from that of the baseline, root mean square over particles and frames, when one assumption is changed. Filled: a permutation test tells them from the baseline at P < 0.05; hollow: it does not. Another arrangement is another experiment: its particles are elsewhere from the start.
count = system(sprintf("awk 'END { print NR - 2 }' '%s/assumptions.csv'", data)) + 0
width = 17; height = 2 + 0.52 * count
load style
set lmargin at screen across(9.6); set tmargin at screen 1 - up(0.2)
unset ytics; set grid xtics noytics; set border 1
set yrange [count + 0.6:0.4]; set xrange [0:*]; set xlabel 'distance of the mean tracks (mm)'
command = sprintf("awk -f '%s/csv.awk' -f '%s/pool-ball-piston/assumptions.awk' '%s/assumptions.csv'", tools, tools, data)
field(n, k) = system(sprintf("%s | awk -F '\\t' 'NR == %d { print $%d }'", command, n, k))
do for [n=1:count] {
    set label 100 + n field(n, 1) at screen across(0.2), first n left tc rgb ink noenhanced
    set label 300 + n field(n, 2) at screen across(9.3), first n right tc rgb ink noenhanced
}
set datafile separator "\t"
plot '< '.command using 3:5 with points pt 6 ps 0.8 lw 1.1 lc rgb ours, \
     '' using ($4 < 0.05 ? $3 : NaN):5 with points pt 7 ps 0.8 lc rgb ours
