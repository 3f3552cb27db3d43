# title: Thirteen solids and their clumps
# counterpart: S12 2.9.1 (the solids), Fig. 2.10 (a cylinder at several packing densities, a drawing without numbers)
# needs: solids.csv
# caption: Each solid beside its clump at packing density 1, 1.5 and 2.2, inside its translucent target; bright spheres are large. Under each: number of spheres; mean distance from the surface to the clump, over the radius of the largest sphere inside; volume of the union, over that of the solid; cost of a simulated second with one contact, over that of a sphere of the same volume (sub-contacts over critical step).
width = 17.4; height = 23.2
load style
array solid[13] = ['sphere', 'ellipsoid', 'cylinder', 'cube', 'block', 'parallelepiped', 'tetrahedron', 'cone', 'double-cone', 'hyperboloid', 'barrel', 'disc', 'torus']
tiny = face.(kind eq 'svg' ? ',7.6' : ',5.7')
bold = '{/:Bold '
measures(name) = system(sprintf("od -An -tu4 --endian=big -j16 -N8 '%s/%s.png'", data, name))
# value of a column in the row of a solid at its k-th density
entry(name, k, c) = real(word(system(sprintf("awk -F, '$1 == \"%s\" && ++n == %d { printf \"%%.9e\", $%d }' '%s/solids.csv'", name, k, c, data)), 1))
unset border; unset tics; unset xlabel; unset ylabel; unset key; unset grid
set multiplot
row = 1.0 / 7.15
do for [i=1:13] {
    name = solid[i]
    size_of = measures(name)
    w = real(word(size_of, 1)); h = real(word(size_of, 2))
    panel = (w - 15) / 4.0
    left = i % 2 == 1 ? 0.0 : 0.5
    set lmargin at screen left + across(0.15); set rmargin at screen left + 0.5 - across(0.15)
    top = 1 - row * ((i - 1) / 2) - up(0.15)
    set tmargin at screen top; set bmargin at screen top - row + up(0.3)
    # the cell is 8.4 cm wide; captions take 1.15 cm
    per_cm = w / 8.4
    tall = (height * row - 0.3) * per_cm
    set xrange [0:w]; set yrange [-1.15 * per_cm:tall - 1.15 * per_cm]
    unset label
    if (i == 13) { set label 999 stamp at screen 1 - 0.1 / width, 0.18 / height right font small tc rgb faint noenhanced }
    set label 1 bold.name.'}' at 7.5 + 0.5 * panel, -0.33 * per_cm center font tiny tc rgb ink
    do for [k=1:3] {
        x = 7.5 + (k + 0.5) * panel
        n = entry(name, k, 2)
        off = 100 * entry(name, k, 11) / entry(name, k, 5)
        volume = 100 * entry(name, k, 7) / entry(name, k, 6)
        set label 10 * k + 1 sprintf('%d sphere%s', n, n == 1 ? '' : 's') at x, -0.33 * per_cm center font tiny tc rgb ink
        set label 10 * k + 2 sprintf('off %.1f%%, vol. %.0f%%', off, volume) at x, -0.66 * per_cm center font tiny tc rgb ink
        price = entry(name, k, 20)
        words = price < 10 ? sprintf('cost %.1f', price) : sprintf('cost %.0f', price)
        set label 10 * k + 3 words at x, -0.99 * per_cm center font tiny tc rgb ours
    }
    if (i == 13) {
        set label 900 "Columns: the solid, then packing\ndensity 1, 1.5 and 2.2." at screen 0.53,up(2.75) font tiny tc rgb ink
        set label 901 "off: mean distance from surface to clump,\nof the radius of the largest sphere inside" at screen 0.53,up(1.85) font tiny tc rgb ink
        set label 902 "vol.: of the union, of the solid's\ncost: of a simulated second, of a sphere's" at screen 0.53,up(0.95) font tiny tc rgb ink
    }
    plot data.'/'.name.'.png' binary filetype=png with rgbimage
}
unset multiplot
