/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ELEMENT_SHAPE_FUNCTIONS_H
#define ORTHOSTAT_ELEMENT_SHAPE_FUNCTIONS_H

/* Shape functions of linear and quadratic tets (4 or 10 nodes) and faces (3 or 6), straight or curved, one point at a
 * time: for loads and measures that vary in the element. `at` are barycentric coordinates, x 3 numbers a node. */

/* Local. Each node's shape function, and from these the position of the point. */
void ost_shape_values(int nodes, const double at[4], double *values);
void ost_shape_place(int nodes, const double *values, const double *x, double place[3]);

/* Local. Of a tet: gradients of the shape functions (3 numbers a node). Returns the determinant of the map from the
 * reference tet: six times the volume of a straight tet, positive if it is not inverted. */
double ost_shape_gradients(int nodes, const double at[4], const double *x, double *gradients);

/* Local. That determinant alone. */
double ost_shape_determinant(int nodes, const double at[4], const double *x);

/* Local. Of a face: derivatives of the shape functions by the coordinates of the face's second and third vertex. */
void ost_shape_face_slopes(int nodes, const double at[3], double (*slopes)[2]);

/* Local. Of a face: the area vector of the map from the reference triangle. It points outward if the face is oriented
 * outward; half its length is the area of a straight face. */
void ost_shape_area_vector(int nodes, const double at[3], const double *x, double area_vector[3]);

#endif
