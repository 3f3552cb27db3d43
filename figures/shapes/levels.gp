# title: What a nearer clump costs
# counterpart: none, our own measurement (A00 Tables 3.5 and 3.6 have the run time against spheres per particle)
# needs: levels.csv
# caption: Mean distance from the surface of the solid to the clump, over the radius of the largest sphere inside, against the number of spheres (left) and against the cost of a simulated second with one contact (right; a sphere of the same volume: 1). Levels of 1, 2, 4 ... 256 spheres, or as many as whole rings and mirror images allow. Flat faces and edges are dear: they ask for small spheres, which ask for small steps; round bodies are cheap.
width = 17; height = 9.5
load style
array solid[8] = ['ellipsoid', 'barrel', 'torus', 'cylinder', 'cone', 'cube', 'block', 'disc']
array tone[8] = ['#440154', '#3f4a8a', '#26828e', '#2fa866', '#a2b21b', '#D55E00', '#1a1a1a', '#0072B2']
of(name) = rows('levels', sprintf('$1 == "%s"', name))
set multiplot
set logscale xy; set format y '%g'; set yrange [0.3:150]
do for [i=1:2] {
    set lmargin at screen (i == 1 ? across(1.7) : 0.5 + across(0.9)); set rmargin at screen (i == 1 ? 0.5 - across(0.1) : 1 - across(0.35))
    set tmargin at screen 1 - up(1.5)
    set ylabel (i == 1 ? 'mean deviation (% of largest radius inside)' : '')
    set xlabel (i == 1 ? 'spheres' : 'cost of a simulated second')
    set xrange [(i == 1 ? 0.8 : 0.9):(i == 1 ? 400 : 200)]
    if (i == 2) { unset label 999; unset key } else { set key at screen 0.53,1 - up(0.1) center top maxrows 2 width 1 }
    plot for [k=1:8] of(solid[k]) using (i == 1 ? $2 : $20):(100 * $11 / $5) with linespoints lw 1.1 pt (k + 3) ps 0.5 lc rgb tone[k] title solid[k]
}
unset multiplot
