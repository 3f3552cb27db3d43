# title: One, two and five particles wide
# counterpart: S12 Fig. 4.14
# needs: wide.csv cases.csv
# caption: E(t) on the stepped forward grate (20° and 0°) with the particles made up for it, by the width of the channel in largest diameters, with 95 % intervals; "periodic": without side walls, what leaves by one side comes in by the other. Ticks on the axis: mean residence times.
width = 12; height = 8
load style
array wide[4] = ['width 1', 'width 2', 'width 5', 'width 5 periodic']
array says[4] = ['1 wide', '2 wide', '5 wide', '5 wide, periodic']
array hue[4] = [ours, frictional, thesis, faint]
curve(k) = rows('wide', sprintf('$1 == "%s"', wide[k]))
set xrange [0:180]; set yrange [0:*]
set xlabel 'residence time (s), sampled every 6 s'; set ylabel 'E(t) (1/min)'
set key top right
plot for [k=1:4] curve(k) using (30 * ($3 + $4)):($5 - spread($6)):($5 + spread($6)) with filledcurves fc rgb hue[k] fs transparent solid 0.12 noborder, \
     for [k=1:4] curve(k) using (30 * ($3 + $4)):5 with linespoints pt 5 + 2 * k ps 0.5 lw 1.4 lc rgb hue[k] title says[k], \
     for [k=1:4] rows('cases', sprintf('$1 == "%s"', wide[k])) using (60 * $9):(0) with points pt 11 ps 1.1 lc rgb hue[k]
