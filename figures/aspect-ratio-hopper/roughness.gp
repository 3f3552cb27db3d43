# title: Shape or roughness
# counterpart: none, one step further than the source
# needs: facts.csv runs.csv
# caption: Touching spheres (q = 1) have a pseudo-friction of their own; with four spheres to a diameter (q = 4) it is small and the same for all aspect ratios. Steady rate, solid fraction and co-ordination number of both families at the cheaper setting.
width = 17; height = 6.2
load style
load tools.'/aspect-ratio-hopper/aspect.gpi'
family(name, q) = rows('facts', sprintf('$1 == "%s" && ($5 == %d || $4 == 1)', name, q))
array title_of[3] = ['steady rate (%/s)', 'solid fraction', 'co-ordination number']
array name_of[3] = ['rate', 'solid fraction', 'co-ordination number']
set multiplot
set xrange [0.7:5.3]; set xtics 1; set xlabel 'aspect ratio'
do for [k=1:3] {
    left = 1.6 + 5.5 * (k - 1)
    if (k > 1) { unset label 999; unset key } else { set key at screen 0.5,1 - up(0.12) center top maxrows 1 }
    set lmargin at screen across(left); set rmargin at screen across(left + 3.8)
    set tmargin at screen 1 - up(0.9)
    set ylabel title_of[k]; set format y (k == 2 ? '%.2f' : '%g')
    plot family(name_of[k], 1) using 4:7:(spread($8)) with yerrorbars pt 7 ps 0.7 lw 1.1 lc rgb ours title 'touching spheres, q = 1', \
         family(name_of[k], 1) using 4:7 smooth unique with lines lw 1.2 lc rgb ours, \
         family(name_of[k], 4) using 4:7:(spread($8)) with yerrorbars pt 5 ps 0.7 lw 1.1 lc rgb thesis title 'smooth, q = 4', \
         family(name_of[k], 4) using 4:7 smooth unique with lines lw 1.2 dt (6,3) lc rgb thesis
}
unset multiplot
