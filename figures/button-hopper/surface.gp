# title: Free surface
# counterpart: A00 Fig. 4.20
# needs: surface.csv
# caption: Height of the bed in ten sections across the bin at several times after the stopper is gone, mean over the replicates of the frictionless fill. The profiles of the experiment are only in the figure of the source.
width = 17; height = 8.4
load style
mean(d, t) = sprintf("< awk -F, 'NR > 1 && $1 == %g && $3 > %g && $3 < %g { if (!($4 in n)) x[$4] = $5; n[$4]++; s[$4] += $6 } END { for (k = 1; k <= 10; k++) if (n[k]) print x[k] \",\" s[k] / n[k] }' '%s/surface.csv'", d, t - 0.005, t + 0.005, data).none
array wide[2] = [7.5, 10]
array moment[5] = [0, 0.12, 0.24, 0.36, 0.48]
array shade[5] = ['#440154', '#3f4a8a', '#26828e', '#2fa866', '#a2b21b']
set xrange [-7.5:7.5]; set yrange [0:22]; set xtics 2.5; set ytics 5
set tmargin at screen 1 - up(1.0)
set border 2
set multiplot
do for [i=1:2] {
    set lmargin at screen (i == 1 ? across(1.45) : 0.56); set rmargin at screen (i == 1 ? 0.50 : 1 - across(0.5))
    if (i == 2) { unset label 999 }
    set xlabel 'x (cm)'; set ylabel (i == 1 ? 'height (cm)' : '')
    set label 1 sprintf('{/:Bold D = %g cm}', wide[i]) at graph 0.03,0.95 left tc rgb ink
    set arrow 1 from graph 0, first 0 to first -wide[i] / 2, first 0 nohead lw 3 lc rgb ink   # the floor
    set arrow 2 from first wide[i] / 2, first 0 to graph 1, first 0 nohead lw 3 lc rgb ink
    if (i == 1) { set key at screen 0.53,1 - up(0.15) center top maxrows 1 width 1 } else { unset key }
    plot for [k=1:5] mean(wide[i], moment[k]) using 1:2 with linespoints pt 7 ps 0.45 lw 1.4 lc rgb shade[k] title sprintf('%.2f s', moment[k])
}
unset multiplot
