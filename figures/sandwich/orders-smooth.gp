# title: Orders on smooth motion
# counterpart: none, our own measurement
# needs: orders.csv slopes.csv
# caption: Largest error over 2.4 periods with both contacts closed, against steps in half a period. Behind each name: slope without damping, slope with e = 0.7, through the three finest points above rounding (1e-9). Orders of the table of schemes are met within 0.1 everywhere; explicit Verlet schemes and Numerov with one-sided dashpots fall to first order with damping.
width = 17; height = 11.5
load style
kind_of = 'smooth'; lowest = 1e-12; along = 'steps in half a period'
load tools.'/sandwich/orders.gpi'
