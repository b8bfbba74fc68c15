// The stages of a run that both models walk through, and the windows through which the host loads them.
package stages;

  typedef enum logic [3:0] {
    IDLE,
    SUM_NORM,    // N <- |I| + sum |w|, a tap a cycle
    DIVIDE,      // a bit of 1 / N a cycle
    STORE,       // ... into its register
    ACCUMULATE,  // s <- I + sum w L, a tap a cycle
    MULTIPLY,    // s / N: s times the reciprocal,
    ROUND,       // ... shifted and rounded
    PULL,        // R u
    PUBLISH,     // V onto state and link
    CHECK        // the convergence detector ends a sweep
  } stage_t;

  typedef enum logic [2:0] {
    WEIGHT,
    SOURCE,
    BIAS,
    OUTPUT,
    ROW_BEATS,
    LAST_PHASE,
    MOST_BEATS
  } window_t;

endpackage
