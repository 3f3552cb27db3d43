# title: Load on the side walls by depth
# counterpart: A00 Fig. 5.20
# needs: pressure.csv
# caption: Normal force per height of wall, mean of both walls from 0.1 to 0.3 s after the opening, with the 95 % interval over replicates. Curves: Janssen between two walls with the friction of 0.5, K by least squares.
width = 17; height = 7
load style
load tools.'/aspect-ratio-hopper/aspect.gpi'
set multiplot
stats data.'/pressure.csv' using 4 every ::1 nooutput
most = STATS_max
stats data.'/pressure.csv' using 3 every ::1 nooutput
set xrange [0:1.25 * most]; set yrange [1.05 * STATS_max:0]
do for [k=1:4] {
    left = 1.8 + 3.8 * (k - 1)
    if (k > 1) { unset label 999; unset key } else { set key at screen 0.5,1 - up(0.12) center top maxrows 1 }
    set lmargin at screen across(left); set rmargin at screen across(left + 3.4)
    set tmargin at screen 1 - up(0.9)
    set xlabel 'load (N/m)'; set xtics 0,(most > 150 ? 100 : most > 60 ? 50 : 20)
    set ylabel (k == 1 ? 'depth below the surface (cm)' : ''); set format y (k == 1 ? '%g' : '')
    K = number(system(sprintf("awk -F, '$1 == %d { v = $7 } END { print v }' '%s/pressure.csv'", k, data)))
    set label 1 sprintf('aspect %d', k) at graph 0.95,0.93 right tc rgb ink
    set label 2 sprintf('K = %.2f', K) at graph 0.95,0.85 right tc rgb ink
    plot shape('pressure', k) using 4:3:(spread($5)) with xerrorbars pt 7 ps 0.6 lw 1 lc rgb ours title 'Clast', \
         shape('pressure', k) using 6:3 smooth unique with lines lw 1.4 dt (6,3) lc rgb experiment title 'Janssen'
}
unset multiplot
