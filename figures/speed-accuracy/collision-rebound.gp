# title: One collision: rebound
# counterpart: none, our own measurement
# needs: points.csv
# caption: Relative error of the rebound speed. Each mark is a scheme at one number of steps per contact (2, 2.8, 4, ... from the left); errors are root mean squares over the places within a step where the contact can begin. Black: the front, settings that no other one beats in both; an error counts only if no finer step of the scheme has a larger one.
width = 17; height = 15
load style
quantity = "rebound"; axis = 11; ytitle = "error of the rebound"
load tools.'/speed-accuracy/collision.gpi'
