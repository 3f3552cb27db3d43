# title: Solid fraction of the beds, on cells of a tenth of the width
# counterpart: A00 Fig. 5.3
# needs: cells.csv
# caption: Number of centroids in a cell times the area of a particle, over the area of the cell, as in the source; beds at rest, before the orifice opens. Cells of the surface are partly empty.
width = 17; height = 13
load style
load tools.'/aspect-ratio-hopper/aspect.gpi'
set multiplot
set palette defined (0 '#ffffff', 0.3 '#e8e1ef', 0.5 '#9ebcda', 0.7 '#4a78b5', 0.85 '#2a4a8b', 1 '#0b1c4d')
set cbrange [0.4:1]; set cblabel 'solid fraction'
set size ratio -1
unset grid
set xrange [-side:side]; set yrange [0:6.4 * side]
set xtics (sprintf('%g', -0.5 * side) -0.5 * side, '0' 0, sprintf('%g', 0.5 * side) 0.5 * side); set ytics side
set xlabel 'x (cm)'
do for [k=1:4] {
    if (k > 1) { unset label 999 }
    left = 1.9 + 3.25 * (k - 1)
    set lmargin at screen across(left); set rmargin at screen across(left + 3.05)
    set bmargin at screen up(1.8); set tmargin at screen 1 - up(0.7)
    set ylabel (k == 1 ? 'z (cm)' : '')
    if (k > 1) { set format y '' }
    set title 'aspect '.k offset 0,-0.5
    if (k == 4) { set colorbox user origin screen across(14.9),up(1.8) size screen across(0.3),up(8.4) } else { unset colorbox }
    plot rows('cells', sprintf('$1 == "%d" && $2 == 0', k)) using 3:4:5 with image pixels
}
unset multiplot
