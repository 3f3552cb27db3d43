# title: Velocity profile
# counterpart: A00 Fig. 4.18
# needs: velocity_samples.csv velocity_fit.csv
# caption: Vertical velocity of the buttons in a band one button wide, 9 cm above the orifice, over one video frame; all replicates of the frictionless fill. Curves: kinematic model v = v₀ exp(−x²/4Bh), with v₀ from the centre as in the source (solid) and with v₀ free (dashes), d = 1.2 cm. Right margin of each panel: mean ± standard deviation of ours and of Table 4.7. The samples of the experiment are only in the figure of the source.
width = 17; height = 7.8
load style
entry(d, set, column) = number(system(sprintf("awk -F, '$1 == %g && $2 == \"%s\" { v = $%d } END { print v }' '%s/velocity_fit.csv'", d, set, column, data)))
model(x, v0, b) = v0 * exp(-x * x / (4 * b * 9))
array wide[2] = [7.5, 10]
array mean_experiment[2] = [-0.234, -0.409]; array sd_experiment[2] = [0.166, 0.284]   # Table 4.7
array mean_thesis[2] = [-0.241, -0.407]; array sd_thesis[2] = [0.183, 0.315]
stats rows('velocity_samples', '$1 == 7.5 || $1 == 10') using 4 nooutput
low = floor(10 * (STATS_min < -0.8 ? STATS_min : -0.8)) / 10.; high = STATS_max > 0 ? 0.1 : 0.05
set xrange [-7.5:10.9]; set yrange [low:high]
set xtics ('−6' -6, '−3' -3, '0' 0, '3' 3, '6' 6); set format y '%.1f'
set tmargin at screen 1 - up(1.3)
set xzeroaxis lt 1 lw 0.5 lc rgb faint
set key at screen 0.53,1 - up(0.12) center top maxrows 1 samplen 1.6 width 3
set multiplot
do for [i=1:2] {
    D = wide[i]
    set lmargin at screen (i == 1 ? across(1.6) : 0.56); set rmargin at screen (i == 1 ? 0.505 : 1 - across(0.3))
    if (i == 2) { unset label 999; unset key }
    set xlabel 'distance from the centre line (cm)' offset -3, 0
    set ylabel (i == 1 ? 'vertical velocity (m/s)' : '')
    set label 1 sprintf('{/:Bold D = %g cm}', D) at graph 0.02,1.04 left tc rgb ink
    v0 = entry(D, 'centre', 3); b = entry(D, 'centre', 4); v1 = entry(D, 'free', 3); b1 = entry(D, 'free', 4)
    set label 2 sprintf('B = %.2f d  (%.2f d, v_0 free)', entry(D, 'centre', 5), entry(D, 'free', 5)) at graph 1,1.04 right tc rgb ours
    set label 4 'mean ± sd' at first 9.2, graph 0.03 center tc rgb faint font small
    set arrow 1 from first 7.5, graph 0 to first 7.5, graph 1 nohead lw 0.5 lc rgb hair
    m = entry(D, 'centre', 7); s = entry(D, 'centre', 8)
    plot rows('velocity_samples', sprintf('$1 == %g', D)) using 3:4 with points pt 7 ps 0.3 lc rgb ours_light, \
         [-7.5:7.5] model(x, v0, b) with lines lw 1.8 lc rgb ours title 'Clast', \
         [-7.5:7.5] model(x, v1, b1) with lines lw 1 dt (6,4) lc rgb ours title 'v_0 free', \
         '+' using (8.25):(mean_experiment[i]):(sd_experiment[i]) every ::0::0 with yerrorbars pt 7 ps 0.7 lw 1 lc rgb experiment title 'experiment', \
         '+' using (9.25):(mean_thesis[i]):(sd_thesis[i]) every ::0::0 with yerrorbars pt 9 ps 0.7 lw 1 lc rgb thesis title 'thesis', \
         '+' using (10.25):(m):(s) every ::0::0 with yerrorbars pt 7 ps 0.7 lw 1.2 lc rgb ours
}
unset multiplot
