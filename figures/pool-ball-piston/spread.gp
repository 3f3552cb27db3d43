# title: How replicates part
# counterpart: none, the source has no such study
# needs: spread.csv growth.csv
# caption: Standard deviation of the positions of replicates, root mean square over the particles, from the start of the piston, for errors of the placing of their assumed size and of fractions of it. A motion without chaos would keep the lines as far apart as they begin.
width = 12; height = 9
load style
array error_of[5] = [1, 0.1, 0.01, 0.001, 0.0001]
array name_of[5] = ['errors as assumed', '1/10', '1/100', '1/1000', '1/10 000']
set tmargin at screen 1 - up(1.2); set lmargin at screen across(1.9)
set logscale y; set format y '10^{%T}'; set xrange [0:5]; set xlabel 'time (s)'; set ylabel 'spread of replicates (mm)'
set key at screen 0.5,1 - up(0.1) center top maxrows 2
of(e) = rows('spread', sprintf('$1 == %g', e))
found(e) = system(sprintf("awk -F, '$1 == %g { n = 1 } END { print n + 0 }' '%s/spread.csv'", e, data)) + 0
plot for [k=1:5] found(error_of[k]) ? of(error_of[k]) : '< echo NaN,NaN,NaN' using 2:3 with lines lw 1.5 lc rgb colour[k] \
     title (found(error_of[k]) ? name_of[k] : '')
