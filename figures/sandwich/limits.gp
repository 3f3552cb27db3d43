# title: Where schemes fail
# counterpart: none, our own measurement
# needs: theory.csv limits.csv
# caption: Fewest steps per contact that hold, against the restitution of the contact; a contact lasts until its force ends. Lines: eigenvalues of the amplification matrices; marks: the running engine, both contacts of a pressed ball closed, bisected until a guard stops the run. Stable above a line, failing below; BDF4 is stable above its solid line and again below its dashed one, and at any step for e < 0.47. Taylor, BDF4 (but for very large steps) and Adams-Moulton have no stable step without damping: their lines rise and end before e = 1. Position Verlet needs 2.2 steps instead of 1.6 with the least damping, because its dashpots feel a velocity one step old. Backward Euler, Newmark-β, the trapezoid rule and BDF2 hold at any step and are not here. Symplectic Euler and velocity Verlet lie on the leapfrog's line.
width = 17; height = 11
load style
load tools.'/sandwich/sandwich.gpi'
array explicit[6] = [1, 2, 3, 4, 5, 6]
array implicit[6] = [8, 11, 12, 14, 15, 16]
# position Verlet's limit jumps at 1: no line across
theory(k, upper) = rows('theory', sprintf('$1 == "%s" && $3 == %d && ($2 < 1 || $1 != "position-verlet")', key_of[k], upper))
engine(k) = rows('limits', sprintf('$1 == "%s"', key_of[k]))
set multiplot
set logscale y; set xrange [0.03:1.03]; set yrange [0.2:50]; set ytics (0.2, 0.5, 1, 2, 5, 10, 20, 50); set format y '%g'
set xlabel 'restitution'
set tmargin at screen 1 - up(1.5)
do for [i=1:2] {
    set lmargin at screen (i == 1 ? across(1.6) : 0.5 + across(1.1)); set rmargin at screen (i == 1 ? 0.5 : 1 - across(0.3))
    set ylabel (i == 1 ? 'steps per contact at the limit' : '')
    if (i == 2) { unset label 999 }
    set key at screen (i == 1 ? 0.29 : 0.78),1 - up(0.1) center top maxrows 3 font small
    if (i == 1) {
        plot for [j=1:6] theory(explicit[j], 1) using 2:5 with lines lw 1.2 lc rgb tint[explicit[j]] notitle, \
             for [j=1:6] engine(explicit[j]) using 2:7 with points pt mark[explicit[j]] ps 0.8 lc rgb tint[explicit[j]] title name_of[explicit[j]]
    } else {
        plot for [j=1:6] theory(implicit[j], 1) using 2:5 with lines lw 1.2 lc rgb tint[implicit[j]] notitle, \
             theory(11, 0) using 2:5 with lines lw 1.2 dt '-' lc rgb tint[11] notitle, \
             for [j=1:6] engine(implicit[j]) using 2:7 with points pt mark[implicit[j]] ps 0.8 lc rgb tint[implicit[j]] title name_of[implicit[j]]
    }
}
unset multiplot
