/* Nothing: code generation has its own. */
