# title: Young's modulus, Hooke and Hertz
# counterpart: S12 Figs 2.18 and 2.20
# needs: scan.csv
# caption: Largest overlap and duration without damping against Young's modulus over its largest (100 MPa), a ball of 10 mm at 0.5 m/s.
width = 17; height = 7.5
load style
scan = 'modulus'; of = 3; title_x = 'modulus / largest modulus'
load tools.'/collision/scan.gpi'
