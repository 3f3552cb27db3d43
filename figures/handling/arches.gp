# title: How often the bin ends in an arch
# counterpart: A00 3.9.4, a sentence
# needs: bin.csv
# caption: Share of the runs in which spheres stay above the middle of the slot when nothing moves any more, with the 95 % interval of the share over runs (Wilson). The source has a permanent arch at 5 cm for every shape.
width = 12; height = 7.5
load style
array slot[3] = [5, 6.5, 8]
array shape[3] = [7, 5, 9]
z = 1.96
centre(p, n) = (p + z * z / (2 * n)) / (1 + z * z / n)
half(p, n) = z / (1 + z * z / n) * sqrt(p * (1 - p) / n + z * z / (4 * n * n))
set xrange [1.1:2.1]; set yrange [-0.05:1.05]
set xlabel 'aspect ratio (length over diameter)'; set ylabel 'share of runs with an arch'
set tmargin at screen 1 - up(0.9)
set key at screen 0.55,1 - up(0.1) center top maxrows 1
plot for [k=1:3] rows('bin', sprintf('$2 == %g', slot[k])) using ($1 + (k - 2) * 0.02):4:(centre($4, $3) - half($4, $3)):(centre($4, $3) + half($4, $3)) \
         with yerrorbars pt shape[k] ps 0.8 lw 1 lc rgb colour[2 * k - 1] title sprintf('%g cm', slot[k])
