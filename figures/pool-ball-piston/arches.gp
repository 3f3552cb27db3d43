# title: How often an arch holds
# counterpart: none, the source does not say
# needs: arches.csv
# caption: Part of the arrangements (each from another seed of the settling) in which more than two of the ten particles are still above the throat when the piston has gone 22.75 cm; bars: 95 % interval of a part. Model runs from the settled bed, for both readings of the 70.0 in the input file: a height, which makes slopes of 60°, or an angle. The column is only two particles wide.
width = 12; height = 8.2
load style
set tmargin at screen 1 - up(1.0)
set xrange [-0.03:0.38]; set xtics (0, 0.1, 0.2, 0.35); set xlabel 'friction, between particles and against the walls'
set yrange [0:1.02]; set ylabel 'part that ends in an arch'
set key at screen 0.5,1 - up(0.1) center top maxrows 1
# E. B. Wilson's interval of a part k of n
mid(k, n) = (k + 1.92) / (n + 3.84)
half(k, n) = 1.96 / (n + 3.84) * sqrt(k * (n - k) / n + 0.96)
of(slopes) = rows('arches', sprintf('$1 == "%s"', slopes))
plot of('60 deg') using ($2-0.004):($4/$3):(mid($4,$3)-half($4,$3)):(mid($4,$3)+half($4,$3)) with yerrorbars pt 7 ps 1 lw 1.1 lc rgb ours title 'slopes of 60°', \
     of('70 deg') using ($2+0.004):($4/$3):(mid($4,$3)-half($4,$3)):(mid($4,$3)+half($4,$3)) with yerrorbars pt 9 ps 1.1 lw 1.1 lc rgb thesis title '70°'
