# title: Bed height against feed
# counterpart: S12 Fig. 3.23
# needs: fast.csv cases.csv
# caption: Wood, bars at 35 mm/s. Filled: from the bars to the tops of the bodies; open: to the outline, dips included. Both axes over the value at 13.6 kg/h, as the source has them; its own statement is one point, 0.7 at half the feed. Bars: 95 % intervals.
width = 12; height = 7.5
load style
fast = rows('cases', '$2 == "fast"')
full(column) = system(sprintf("awk -F, '$1 == \"fast 13.6 kg/h\" { print $%d }' '%s/cases.csv'", column, data)) + 0
h = full(37); o = full(39)
set xrange [0.4:1.1]; set yrange [0.4:1.15]
set xlabel 'feed over 13.6 kg/h'; set ylabel 'bed height over that at 13.6 kg/h'
set key top left
plot '+' using (0.5):(0.7) every ::0::0 with points pt 9 ps 1.2 lc rgb thesis title 'published', \
     fast using ($3 / 13.6 + 0.006):($39 / o):(spread($40) / o) with yerrorbars pt 6 ps 0.8 lw 1 lc rgb ours title 'outline', \
     fast using ($3 / 13.6):($37 / h):(spread($38) / h) with yerrorbars pt 7 ps 0.8 lw 1.1 lc rgb ours title 'tops'
