# title: Discharged mass
# counterpart: A00 Figs 4.13 and 4.14
# needs: cumulative.csv rates.csv summary.csv
# caption: Thin: one replicate each, frictionless fill. Bold with band: their mean and its 95 % interval (a run that has ended keeps its last value). Black dashes: the steady rate of the experiment (Table 4.4) as a slope; where it starts is ours. The curves of the experiment itself are only in the figure of the source.
width = 17; height = 11.5
load style
band(d) = sprintf("< awk -v fill=frictionless -v orifice=%g -v column=5 -v hold=1 -f '%s/button-hopper/band.awk' '%s/cumulative.csv'", d, tools, data).none
total = 66.4   # g, 200 buttons of 0.332 g
slope(d) = number(system(sprintf("awk -F, '$1 == \"frictionless\" && $2 == %g { v = $7 } END { print v }' '%s/summary.csv'", d, data)))
begin(d) = number(system(sprintf("awk -F, '$1 == \"frictionless\" && $2 == %g && $5 != \"nan\" { s += $5; n++ } END { print n ? s / n : 0 }' '%s/rates.csv'", d, data)))
runs(d) = system(sprintf("awk -F, '$1 == \"frictionless\" && $2 == %g { n++; b += $7 } END { if (!n) printf \"not run at this size\"; else printf \"%%d run%%s%%s\", n, n == 1 ? \"\" : \"s\", b ? \", \" b \" blocked\" : \"\" }' '%s/rates.csv'", d, data))
stats data.'/cumulative.csv' using 4 nooutput
end = STATS_max > 1.6 ? 1.6 : STATS_max

set multiplot layout 2,3 margins screen across(1.45),1 - across(0.3),up(1.75),1 - up(0.35) spacing screen across(1.0),up(1.35)
set xrange [0:end]; set yrange [0:70]
set ytics 20; set xtics 0.5
set label 1 at graph 0.97,0.16 right tc rgb ink
set label 2 at graph 0.97,0.07 right tc rgb faint
do for [i=1:5] {
    D = orifice[i]
    if (i > 1) { unset label 999 }
    set xlabel (i > 2 ? 'time (s)' : '')
    set ylabel (i == 1 || i == 4 ? 'mass discharged (g)' : '')
    set label 1 sprintf('{/:Bold D = %g cm}', D)
    set label 2 runs(D)
    q = slope(D); t0 = begin(D)
    plot band(D) using 1:3:4 with filledcurves lc rgb ours_pale, \
         for [r=1:20] rows('cumulative', sprintf('$1 == "frictionless" && $2 == %g && $3 == %d', D, r)) \
             using 4:5 with lines lw 0.5 lc rgb ours_light, \
         [t0:t0 + 0.8 * total / (q > 0 ? q : 1)] q * (x - t0) with lines dt (6,4) lw 1.1 lc rgb experiment, \
         band(D) using 1:2 with lines lw 1.8 lc rgb ours
}
# the sixth panel is the legend
unset border; unset tics; unset xlabel; unset ylabel; unset label 1; unset label 2
set key at graph -0.02,0.85 left top spacing 1.6
set xrange [0:1]; set yrange [0:1]
plot NaN with lines lw 0.5 lc rgb ours_light title 'one replicate', \
     NaN with lines lw 1.8 lc rgb ours title 'mean of the replicates', \
     NaN with filledcurves lc rgb ours_pale title '95 % interval of the mean', \
     NaN with lines dt (6,4) lw 1.1 lc rgb experiment title 'steady rate, experiment'
unset multiplot
