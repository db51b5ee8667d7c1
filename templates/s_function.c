/* A block of Simulink (level-2 C MEX S-function) with the controller below.
 *
 *   mex {{ file }}        then an S-Function block named {{ block }}
 *
 * Parameter: the time of one step of the model. Input: the state. Outputs: the input of the step, and the status below. The
 * state is looked at once in {{ tables.group }} steps. A status other than {{ names.act }} ends the run: the block looks no
 * more and keeps its last input.
 */
#define S_FUNCTION_NAME {{ block }}
#define S_FUNCTION_LEVEL 2
#include "simstruc.h"

{{ controller }}
{% if tables.steers %}#define GROUP_STEPS {{ names.upper }}_GROUP
{% else %}#define GROUP_STEPS 1
{% endif %}#define OUTPUT_WIDTH ({{ names.upper }}_INPUTS > 0 ? {{ names.upper }}_INPUTS : 1)

/* What is kept from step to step: counts[] and the inputs of a group. Outputs work on a copy, for Simulink may ask for them
 * more than once a step. */
enum { STEP, STATUS, {% if tables.memory.is_some() %}MEMORY, {% endif %}COUNTS };
/* Names that end otherwise than those of the controller, whatever it is called. */
enum { COUNTS_KEPT, INPUTS_KEPT, COUNTS_NEXT, INPUTS_NEXT, WORK_VECTORS };

static void mdlInitializeSizes(SimStruct *S)
{
    int i;
    ssSetNumSFcnParams(S, 1);
    if (ssGetNumSFcnParams(S) != ssGetSFcnParamsCount(S)) {
        return;
    }
    ssSetSFcnParamTunable(S, 0, 0);
    if (!ssSetNumInputPorts(S, 1) || !ssSetNumOutputPorts(S, 2)) {
        return;
    }
    ssSetInputPortWidth(S, 0, {{ names.upper }}_STATES);
    ssSetInputPortRequiredContiguous(S, 0, 1);
    ssSetInputPortDirectFeedThrough(S, 0, 1);
    ssSetOutputPortWidth(S, 0, OUTPUT_WIDTH);
    ssSetOutputPortWidth(S, 1, 1);
    ssSetNumSampleTimes(S, 1);
    ssSetNumDWork(S, WORK_VECTORS);
    for (i = 0; i < WORK_VECTORS; ++i) {
        const int counts = i == COUNTS_KEPT || i == COUNTS_NEXT;
        ssSetDWorkWidth(S, i, counts ? COUNTS : GROUP_STEPS * OUTPUT_WIDTH);
        ssSetDWorkDataType(S, i, counts ? SS_UINT32 : SS_DOUBLE);
    }
    ssSetOptions(S, SS_OPTION_EXCEPTION_FREE_CODE);
}

static void mdlInitializeSampleTimes(SimStruct *S)
{
    ssSetSampleTime(S, 0, mxGetScalar(ssGetSFcnParam(S, 0)));
    ssSetOffsetTime(S, 0, 0.0);
}

#define MDL_INITIALIZE_CONDITIONS
static void mdlInitializeConditions(SimStruct *S)
{
    uint32_t *counts = (uint32_t *)ssGetDWork(S, COUNTS_KEPT);
    double *inputs = (double *)ssGetDWork(S, INPUTS_KEPT);
    int i;
    counts[STEP] = 0;
    counts[STATUS] = {{ names.upper }}_{{ names.act }};
{% if tables.memory.is_some() %}    counts[MEMORY] = {{ names.upper }}_START;
{% endif %}    for (i = 0; i < GROUP_STEPS * OUTPUT_WIDTH; ++i) {
        inputs[i] = 0;
    }
}

static void mdlOutputs(SimStruct *S, int_T tid)
{
    const uint32_t *kept_counts = (const uint32_t *)ssGetDWork(S, COUNTS_KEPT);
    const double *kept_inputs = (const double *)ssGetDWork(S, INPUTS_KEPT);
    uint32_t *counts = (uint32_t *)ssGetDWork(S, COUNTS_NEXT);
    double *inputs = (double *)ssGetDWork(S, INPUTS_NEXT);
    double *u = ssGetOutputPortRealSignal(S, 0);
    double *status = ssGetOutputPortRealSignal(S, 1);
    uint32_t step = kept_counts[STEP];
    int i;
    (void)tid;
    for (i = 0; i < COUNTS; ++i) {
        counts[i] = kept_counts[i];
    }
    for (i = 0; i < GROUP_STEPS * OUTPUT_WIDTH; ++i) {
        inputs[i] = kept_inputs[i];
    }
    if (counts[STATUS] == {{ names.upper }}_{{ names.act }}) {
        if (step % GROUP_STEPS == 0) {
            counts[STATUS] = (uint32_t){{ names.function }}((const double *)ssGetInputPortSignal(S, 0), step / GROUP_STEPS,
                {% if tables.memory.is_some() %}&counts[MEMORY], {% endif %}{% if tables.steers %}(double(*)[{{ names.upper }}_INPUTS])inputs{% else %}inputs{% endif %});
        }
        if (counts[STATUS] == {{ names.upper }}_{{ names.act }}) {
            counts[STEP] = step + 1;
        }
    }
    /* The input of the step: once the run has ended, that of the last one. */
    step = counts[STEP] > 0 ? (counts[STEP] - 1) % GROUP_STEPS : 0;
    for (i = 0; i < OUTPUT_WIDTH; ++i) {
        u[i] = inputs[step * OUTPUT_WIDTH + i];
    }
    status[0] = counts[STATUS];
}

#define MDL_UPDATE
static void mdlUpdate(SimStruct *S, int_T tid)
{
    const uint32_t *counts = (const uint32_t *)ssGetDWork(S, COUNTS_NEXT);
    const double *inputs = (const double *)ssGetDWork(S, INPUTS_NEXT);
    uint32_t *kept_counts = (uint32_t *)ssGetDWork(S, COUNTS_KEPT);
    double *kept_inputs = (double *)ssGetDWork(S, INPUTS_KEPT);
    int i;
    (void)tid;
    for (i = 0; i < COUNTS; ++i) {
        kept_counts[i] = counts[i];
    }
    for (i = 0; i < GROUP_STEPS * OUTPUT_WIDTH; ++i) {
        kept_inputs[i] = inputs[i];
    }
}

static void mdlTerminate(SimStruct *S)
{
    (void)S;
}

#ifdef MATLAB_MEX_FILE
#include "simulink.c"
#else
#include "cg_sfun.h"
#endif
