# title: Solid fraction during flow
# counterpart: A00 Fig. 4.12a
# needs: cumulative.csv
# caption: Solid fraction of the bed from its outline in ten sections and the number of buttons left, mean over the replicates of the frictionless fill, until 50 buttons are left. The curves of the experiment are only in the figure of the source.
width = 12; height = 8
load style
band(d) = sprintf("< awk -F, 'NR == 1 || 200 - $6 > 50' '%s/cumulative.csv' | awk -v fill=frictionless -v orifice=%g -v column=7 -v hold=0 -f '%s/button-hopper/band.awk'", data, d, tools).none
set format y '%.2f'
set xlabel 'time (s)'; set ylabel 'solid fraction'
set xrange [0:*]; set yrange [*:*]
set tmargin at screen 1 - up(0.9); set key at screen 0.56,1 - up(0.12) center top maxrows 1
plot for [i=1:5] band(orifice[i]) using 1:2 with lines lw 1.5 lc rgb colour[i] title sprintf('%g cm', orifice[i])
