# title: Bulk density by the width of the channel
# counterpart: S12 Fig. 4.6
# needs: packing.csv
# caption: Solid fraction of equal spheres between smooth side walls n diameters apart. Published: one perfect layer (S12 4.8 and 4.10). Ours: poured beds about six layers deep, five each, with the 95 % interval of the mean; walls with the friction of the particles. The dashed lines are the wide bed of each.
width = 12; height = 8
load style
wide(column) = system(sprintf("awk -F, 'NR > 1 && $1 == 10 { print $%d }' '%s/packing.csv'", column, data)) + 0
set lmargin at screen across(1.9)
set xrange [0.5:10.6]; set yrange [0.38:0.64]
set xlabel 'width of the channel (diameters)'; set ylabel 'bulk density over solid density'
set key bottom right
theory(n) = n < 1.5 ? 0.5236 : 0.28 * (2.05 * n - 1) / n
set arrow 1 from 0.5,0.574 to 10.6,0.574 nohead dt (6,4) lw 0.8 lc rgb thesis
set arrow 2 from 0.5,wide(2) to 10.6,wide(2) nohead dt (6,4) lw 0.8 lc rgb ours
set samples 19
plot '+' using (floor($0) / 2.0 + 1.5):(floor($0) / 2.0 + 1.5 < 2 ? NaN : theory(floor($0) / 2.0 + 1.5)) with lines lw 0.9 lc rgb thesis, \
     rows('packing', '1') using 1:5 with points pt 9 ps 0.9 lc rgb thesis title 'published', \
     rows('packing', '1') using 1:2:(spread($3)) with yerrorbars pt 7 ps 0.8 lw 1.1 lc rgb ours title 'poured'
