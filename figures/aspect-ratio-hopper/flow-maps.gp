# title: Solid fraction during the discharge
# counterpart: A00 Fig. 5.9
# needs: cells.csv
# caption: Spheres (top) and aspect ratio 3 (bottom), as in the source; cells and scale as for the beds at rest.
width = 17; height = 15
load style
load tools.'/aspect-ratio-hopper/aspect.gpi'
array when[5] = [0, 0.25, 0.5, 1, 1.5]
set multiplot
set palette defined (0 '#ffffff', 0.3 '#e8e1ef', 0.5 '#9ebcda', 0.7 '#4a78b5', 0.85 '#2a4a8b', 1 '#0b1c4d')
set cbrange [0:1]; set cblabel 'solid fraction'
set size ratio -1
unset grid
set xrange [-side:side]
set xtics (sprintf('%g', -0.5 * side) -0.5 * side, '0' 0, sprintf('%g', 0.5 * side) 0.5 * side); set ytics side
do for [row=0:1] {
    do for [k=1:5] {
        left = 1.8 + 2.6 * (k - 1)
        set lmargin at screen across(left); set rmargin at screen across(left + 2.4)
        set yrange [0:(row == 0 ? 3.9 : 5.8) * side]
        set bmargin at screen up(row == 0 ? 9.5 : 1.7); set tmargin at screen 1 - up(row == 0 ? 0.6 : 6.1)
        if (row == 0) { set xtics (-0.5 * side, 0, 0.5 * side) format '' } else { set xtics (sprintf('%g', -0.5 * side) -0.5 * side, '0' 0, sprintf('%g', 0.5 * side) 0.5 * side) }
        set xlabel (row == 1 ? 'x (cm)' : '') offset 0,0.3
                set format y (k == 1 ? '%g' : '')
        set ylabel (k == 1 ? (row == 0 ? 'aspect 1: z (cm)' : 'aspect 3: z (cm)') : '')
        set title (row == 0 ? sprintf('%g s', when[k]) : '') offset 0,-0.6
        if (k == 5 && row == 1) { set colorbox user origin screen across(14.85),up(2.0) size screen across(0.3),up(8.6) } else { unset colorbox }
        plot rows('cells', sprintf('$1 == "%d" && $2 == %g', row == 0 ? 1 : 3, when[k])) using 3:4:5 with image pixels
        unset label 999
    }
}
unset multiplot
