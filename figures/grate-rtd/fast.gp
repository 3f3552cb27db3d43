# title: Wood on the backward grate, bars at 35 mm/s
# counterpart: S12 Figs 3.20 and 3.21
# needs: fast.csv cases.csv
# caption: Left: share of the tracers that has left; right: residence times per interval of 6 s, over the mean. The source sees a small second peak at 1.45 (dashed) in 148 tracers; whether ours is more than chance is in the table.
width = 17; height = 7.6
load style
curve = rows('fast', '$1 == "fast 13.6 kg/h"')
mean = system(sprintf("awk -F, '$1 == \"fast 13.6 kg/h\" { print $9 }' '%s/cases.csv'", data)) + 0
set multiplot layout 1,2 margins screen across(1.7),1 - across(0.3),up(1.65),1 - up(0.4) spacing screen across(1.9),up(1.0)
set xrange [0:3]; set yrange [0:1.02]; set xtics 0.5
set xlabel 'time over mean'; set ylabel 'F'
plot curve using ($4 / mean):($7 - spread($8)):($7 + spread($8)) with filledcurves fc rgb ours_pale fs solid 0.7 noborder, \
     curve using ($4 / mean):7 with lines lw 1.5 lc rgb ours
unset label 999
set yrange [0:*]
set ylabel 'E x mean'
set arrow 1 from 1.45,graph 0 to 1.45,graph 1 nohead dt (6,4) lw 0.8 lc rgb thesis
plot curve using 13:(($5 - spread($6)) * mean):(($5 + spread($6)) * mean) with filledcurves fc rgb ours_pale fs solid 0.7 noborder, \
     curve using 13:($5 * mean) with linespoints pt 7 ps 0.4 lw 1.4 lc rgb ours
unset multiplot
