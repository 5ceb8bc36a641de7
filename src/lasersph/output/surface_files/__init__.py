"""Files of surface metrology: height maps written for, and measured ones read from, microscopes.

sdf               the ASCII format of ISO 25178-71
x3p               the packed XML format of ISO 25178-72
text              columns with units in their names, and matrices of usual microscopes
read              `read_surface`: any of them, by the ending of the name
"""
