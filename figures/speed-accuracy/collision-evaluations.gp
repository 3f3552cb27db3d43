# title: One collision: error against force evaluations
# counterpart: none, our own measurement
# needs: points.csv
# caption: As the figure before; force evaluations belong to the method, processor time to our code, too. Each mark is a scheme at one number of steps per contact (2, 2.8, 4, ... from the left); errors are root mean squares over the places within a step where the contact can begin. Black: the front, settings that no other one beats in both; an error counts only if no finer step of the scheme has a larger one.
width = 17; height = 15
load style
quantity = "largest"; axis = 11; ytitle = "largest of the three errors"
load tools.'/speed-accuracy/collision.gpi'
