# title: Particles out of the bin
# counterpart: A00 Fig. 3.31
# needs: discharge.csv bin.csv
# caption: Number of the 200 two-sphere particles that have passed the slot, by its width and by the aspect ratio of the particles; one line per run, colour by aspect ratio. A curve that ends flat below the others is an arch that holds. Aspect ratios and widths other than 5 cm are ours: those of the source are only in its figures.
width = 17; height = 7.6
load style
array slot[3] = [5, 6.5, 8]
array aspect[5] = ['1.2', '1.4', '1.6', '1.8', '2.0']
array hue[5] = ['#440154', '#3f4a8a', '#26828e', '#2fa866', '#c9a800']
stats data.'/discharge.csv' using 4 nooutput
end = STATS_max
set multiplot layout 1,3 margins screen across(1.6),1 - across(0.3),up(1.65),1 - up(0.9) spacing screen across(1.0),up(1.0)
set xrange [0:end]; set yrange [0:205]
set ytics 50
do for [k=1:3] {
    if (k > 1) { unset label 999 }
    set xlabel 'time (s)'
    set ylabel (k == 1 ? 'particles out' : '')
    set label 1 sprintf('{/:Bold D = %g cm}', slot[k]) at graph 0.03,0.92 left tc rgb ink
    if (k == 1) { set key at screen 0.55,1 - up(0.1) center top maxrows 1 } else { unset key }
    plot for [a=1:5] for [r=1:20] rows('discharge', sprintf('$1 == "%s" && $2 == %g && $3 == %d', aspect[a], slot[k], r)) \
             using 4:5 with lines lw 0.9 lc rgb hue[a] notitle, \
         for [a=1:5] NaN with lines lw 2 lc rgb hue[a] title 'aspect '.aspect[a]
}
unset multiplot
