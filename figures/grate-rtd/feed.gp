# title: Mean residence time against feed
# counterpart: S12 Figs 4.13 and 3.22
# needs: feeds.csv
# caption: Left: clay on the backward grate, feed per metre of width; the feeds other than 20 kg/h are ours; open circles: bars and feed at ten times the speed, moved by 1.3 kg/h to the right. Right: wood, bars at 35 mm/s, both axes over their largest value as the source has them. Bars: 95 % intervals.
width = 17; height = 7.6
load style
set key off
set multiplot layout 1,2 margins screen across(1.7),1 - across(0.3),up(1.65),1 - up(0.4) spacing screen across(1.9),up(1.0)
quick = rows('feeds', '$1 == "clay10"')
clay = rows('feeds', '$1 == "clay"')
fast = rows('feeds', '$1 == "fast"')
set xrange [0:45]; set yrange [0:*]
set xlabel 'feed (kg/h)'; set ylabel 'mean residence time (min)'
plot quick using ($2 + 1.3):3:(spread($4)) with yerrorbars pt 6 ps 0.7 lw 1.1 lc rgb faint, \
     clay using 2:3:(spread($4)) with yerrorbars pt 7 ps 0.7 lw 1.1 lc rgb ours
unset label 999
stats fast using 2 nooutput name 'F'
stats fast using 3 nooutput name 'T'
set xrange [0:1.1]; set yrange [0:1.25]; set xtics 0.2
set xlabel 'feed over largest feed'; set ylabel 'mean over largest mean'
plot fast using ($2 / F_max):($3 / T_max):(spread($4) / T_max) with yerrorbars pt 7 ps 0.7 lw 1.1 lc rgb ours
unset multiplot
