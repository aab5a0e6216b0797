/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ORTHOSTAT_H
#define ORTHOSTAT_ORTHOSTAT_H

#include "orthostat/analysis.h"
#include "orthostat/axes.h"
#include "orthostat/case.h"
#include "orthostat/context.h"
#include "orthostat/effect.h"
#include "orthostat/exact.h"
#include "orthostat/field.h"
#include "orthostat/ledger.h"
#include "orthostat/material.h"
#include "orthostat/mesh.h"
#include "orthostat/mesh_file.h"
#include "orthostat/plan.h"
#include "orthostat/problem.h"
#include "orthostat/refine.h"
#include "orthostat/result.h"
#include "orthostat/scene.h"
#include "orthostat/solver.h"
#include "orthostat/status.h"
#include "orthostat/verify.h"

#endif
