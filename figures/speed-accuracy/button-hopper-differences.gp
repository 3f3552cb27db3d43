# title: Button hopper: what can be told from zero
# counterpart: none, our own measurement
# needs: points.csv button_runs.csv
# caption: Mean of the paired differences from the thesis's setting with its 95 % interval: flow rate and bulk density of the flowing bed, orifice 10 cm. Filled: the interval does not hold zero. On the right processor time per simulated second and the largest overlap of all runs, of a radius (the default guard stops a run at 5 %). Grey: ±1 %; what is more than 9 % off is printed.
count = system(sprintf("awk -F, '$1 == \"button-hopper\" && $3 == \"rate\" && $18 == 0' '%s/points.csv' | wc -l", data)) + 0
width = 17; height = 2.6 + 0.56 * count
load style
edge = 9 # %, of both frames; what lies beyond is printed
table(quantity, condition) = sprintf("< awk -F, '$1 == \"button-hopper\" && $3 == \"%s\" && $18 == 0 { n++; if (%s) printf \"%%d,%%s,%%.8g,%%.8g,%%s,%%s,%%s\\n\", n, $5, 100 * $12, 100 * ($15 - $13), $8, 100 * $20, $17 }' '%s/points.csv'", quantity, condition, data).none
said(quantity, n, column) = system(sprintf("awk -F, '$1 == \"button-hopper\" && $3 == \"%s\" && $18 == 0 && ++n == %d { print $%d }' '%s/points.csv'", quantity, n, column, data))
set multiplot
unset ytics; set border 1; set xtics font small; set grid xtics noytics
set yrange [count + 0.6:0.4]; set xrange [-edge:edge]; set xtics 4; unset key
set tmargin at screen 1 - up(0.9)
array quantity[2] = ['rate', 'density']
array heading[2] = ['flow rate', 'bulk density']
do for [i=1:2] {
    set lmargin at screen (i == 1 ? across(3.4) : across(9.2)); set rmargin at screen (i == 1 ? across(8.7) : across(13.6))
    set xlabel 'difference (%)'
    set label 1 heading[i] at graph 0.5, screen 1 - up(0.5) center tc rgb ink
    set object 1 rectangle from first -1, graph 0 to first 1, graph 1 behind fs solid 1 noborder fc rgb '#ececec'
    set arrow 1 from first 0, graph 0 to first 0, graph 1 nohead lw 0.9 lc rgb ink
    if (i == 1) {
        do for [k=1:count] { set label 100 + k said('rate', k, 5) at screen across(0.2), first k left tc rgb ink }
    } else {
        unset label 999
        do for [k=1:count] {
            unset label 100 + k
            set label 200 + k sprintf('%.2g', said('rate', k, 8) + 0) at screen across(14.7), first k center tc rgb ink
            overlap = said('rate', k, 20) eq 'nan' ? '–' : sprintf('%.1f %%', 100 * (said('rate', k, 20) + 0))
            set label 300 + k overlap at screen across(16.1), first k center tc rgb ink
        }
        set label 2 'CPU, s/s' at screen across(14.7), screen 1 - up(0.5) center tc rgb ink
        set label 3 'overlap' at screen across(16.1), screen 1 - up(0.5) center tc rgb ink
    }
    inside = sprintf('$13 ~ /^[0-9]/ && 100 * $13 < %g', edge); outside = sprintf('100 * $13 >= %g', edge)
    # labels without a point end gnuplot 5.4 by a null pointer
    beyond = system(sprintf("awk -F, '$1 == \"button-hopper\" && $3 == \"%s\" && $18 == 0 && %s { n = 1 } END { print n + 0 }' '%s/points.csv'", quantity[i], outside, data)) + 0
    plot table(quantity[i], inside) using 3:1:4 with xerrorbars pt 6 ps 0.7 lw 1.1 lc rgb ours, \
         table(quantity[i], inside.' && $17 == 1') using 3:1 with points pt 7 ps 0.7 lc rgb ours, \
         for [k=1:beyond] table(quantity[i], outside) using (0.97 * edge):1:(sprintf('%+.0f ± %.0f →', $3, $4)) with labels right font small tc rgb ours
}
unset multiplot
