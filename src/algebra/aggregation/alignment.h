/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_AGGREGATION_ALIGNMENT_H
#define ORTHOSTAT_ALGEBRA_AGGREGATION_ALIGNMENT_H

#include "algebra/aggregation/graph.h"

/* Collective. How well the edges follow the stiff directions: over the nodes of all ranks, the mean of the squared
 * length, in the metric, of a unit step along the node's edge that is stiffest, over that of a step along the stiff
 * direction itself. 1 where every node has an edge along it, about 3 to 5 on unstructured meshes at a ratio of moduli
 * of 1000; 1 also for isotropic bodies. Where two directions are equally stiff, the fourth stiffest edge counts: a node
 * of a mesh that follows them has as many in their plane. */
OstStatus ost_metric_graph_misalignment(const OstMetricGraph *graph, double *mean);

/* Collective. How flat what lies at the surface is: over the nodes there, the mean of how far their neighbours are
 * spread in the widest direction over that along the normal, in the metric. About 1 in regular meshes. */
OstStatus ost_metric_graph_flatness(const OstMetricGraph *graph, double *mean);

/* Collective. How long what lies at the surface is over the thickness of the body there, in the metric: the geometric
 * mean over the surface, of nodes at random. The thickness is found by steps from node to node, straight through the
 * body. 0 where there is no such node. */
OstStatus ost_metric_graph_slenderness(const OstMetricGraph *graph, double *mean);

#endif
