# title: Speed of impact, Hooke and Hertz
# counterpart: S12 Figs 2.17 and 2.19
# needs: scan.csv
# caption: Largest overlap and duration without damping against the speed over its largest (1 m/s), a ball of 10 mm and 100 MPa. With the stiffness of S12 2.36, Hooke's overlap is the smaller one at any overlap below about a radius; the source's text on Fig. 2.17 says the opposite.
width = 17; height = 7.5
load style
scan = 'speed'; of = 4; title_x = 'speed / largest speed'
load tools.'/collision/scan.gpi'
