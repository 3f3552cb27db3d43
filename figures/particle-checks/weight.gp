# title: A particle comes to rest
# counterpart: A00 Fig. 3.2
# needs: weight.csv
# caption: Two spheres, upright on a floor, gravity set in at 0; damping 0.21 (left) and 0.5 (right); the critical step, a tenth and a hundredth of it. (a) velocity towards the floor, (b) elastic force, (c) force of the dashpot, (d) their sum; the weight is 0.2105 N. In the source all four depend on the step; in Clast the steps fall on one another: an error of the integration, not of the particle, is what could set them apart.
width = 17; height = 17
load style
load tools.'/particle-checks/panels.gpi'
array damping[2] = [0.21, 0.5]
array step[3] = ['1.044e-05', '1.044e-06', '1.044e-07']
array step_name[3] = ['critical step', 'a tenth', 'a hundredth']
array name[4] = ['velocity (mm/s)', 'elastic force (N)', 'dashpot (N)', 'contact force (N)']
array at[4] = [5, 6, 7, 8]
array factor[4] = [1000, 1, 1, 1]
of(d, s) = rows('weight', sprintf('$1 == "vertical" && $2 == %g && $3 == "%s"', d, s))
array low_end[4] = [-0.6, 0, -0.15, 0]
array tic[4] = [0.6, 0.1, 0.1, 0.1]
array high_end[4] = [1.2, 0.4, 0.25, 0.4]
set multiplot
set xrange [0:5]; set xtics 1; set format y '%g'
do for [j=1:4] {
    do for [i=1:2] {
        set lmargin at screen left(i, 2); set rmargin at screen right(i, 2)
        set bmargin at screen low(j, 4); set tmargin at screen high(j, 4)
        set yrange [low_end[j]:high_end[j]]; set ytics tic[j]
        set label 1 letter(j).(j == 1 ? sprintf('  damping %g', damping[i]) : '') at graph 0,1.07 left
        set xlabel (j == 4 ? 'time (ms)' : ''); set ylabel (i == 1 ? name[j] : '')
        if (i + j > 2) { unset label 999; unset key }
        if (i == 2 && j == 1) { set key at graph 1,0.98 right top }
        plot (j == 4 ? 0.2105 : NaN) with lines lw 0.8 dt (6,4) lc rgb faint notitle, \
             for [k=1:3] of(damping[i], step[k]) using ($4*1000):(factor[j]*column(at[j])) with lines lw (k == 1 ? 2.4 : 1.2) dt k lc rgb tone[2*k-1] title step_name[k]
    }
}
unset multiplot
