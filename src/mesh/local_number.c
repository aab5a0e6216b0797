/* SPDX-License-Identifier: BSD-3-Clause */
#include "mesh/local_number.h"

#include "core/number_set.h"

OstLocal ost_mesh_local(const OstMesh *mesh, OstGlobal number)
{
    if (number >= mesh->first_node && number < mesh->first_node + mesh->owned_nodes)
        return (OstLocal)(number - mesh->first_node);
    const OstLocal ghost =
        ost_numbers_find(mesh->node_count - mesh->owned_nodes, mesh->node_number + mesh->owned_nodes, number);
    return ghost < 0 ? -1 : mesh->owned_nodes + ghost;
}
