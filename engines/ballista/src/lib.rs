//! What a Ballista cluster needs to know polycsg's functions. They travel by name, so client, scheduler and every executor
//! register them.
use ballista::prelude::{SessionConfigExt, SessionContextExt};
use ballista_core::JobId;
use ballista_core::registry::BallistaFunctionRegistry;
use ballista_core::utils::default_session_builder;
use ballista_executor::execution_engine::{DefaultExecutionEngine, ExecutionEngine, QueryStageExecutor};
use datafusion::error::Result;
use datafusion::execution::SessionState;
use datafusion::physical_optimizer::PhysicalOptimizerRule;
use datafusion::physical_plan::ExecutionPlan;
use datafusion::prelude::{SessionConfig, SessionContext};
use polycsg_datafusion::{BoxJoin, Functions};
use std::sync::Arc;

/// How an executor carries out a stage: as Ballista does, with joins by boxes.
///
/// Plans travel with nested loops, which scheduler and client know; each executor replaces those of its stage. So no codec is needed,
/// and nothing changes for whoever plans.
#[derive(Default)]
pub struct BoxJoinEngine(DefaultExecutionEngine);

impl ExecutionEngine for BoxJoinEngine {
    fn create_query_stage_exec(
        &self,
        job: JobId,
        stage: usize,
        task: usize,
        partitions: Vec<usize>,
        plan: Arc<dyn ExecutionPlan>,
        folder: &str,
        config: &SessionConfig,
    ) -> Result<Arc<dyn QueryStageExecutor>> {
        let plan = BoxJoin.optimize(plan, config.options())?;
        self.0.create_query_stage_exec(job, stage, task, partitions, plan, folder, config)
    }
}

/// An executor's functions: DataFusion's own and polycsg's.
#[must_use]
pub fn executor_functions() -> BallistaFunctionRegistry {
    let mut registry = BallistaFunctionRegistry::default();
    let functions = Functions::default();
    for function in functions.scalars() {
        registry.scalar_functions.insert(function.name().to_string(), Arc::new(function));
    }
    for function in functions.aggregates() {
        registry.aggregate_functions.insert(function.name().to_string(), Arc::new(function));
    }
    registry
}

/// A session of the scheduler, or of this process, with polycsg's functions beside DataFusion's own.
///
/// # Errors
/// Those of the registry.
pub fn session_state(config: SessionConfig) -> Result<SessionState> {
    let mut state = default_session_builder(config)?;
    Functions::default().register(&mut state)?;
    Ok(state)
}

/// A client's session with a cluster, by the scheduler's address, as `df://127.0.0.1:50050`. So many partitions are shuffled.
///
/// # Errors
/// Those of Ballista: the address is none, or nobody answers.
pub async fn connect(scheduler: &str, partitions: usize) -> Result<SessionContext> {
    let config = SessionConfig::new_with_ballista().with_target_partitions(partitions);
    let mut context = SessionContext::remote_with_state(scheduler, default_session_builder(config)?).await?;
    // Ballista takes its own functions in place of those that a state brings, so ours come last.
    Functions::default().register(&mut context)?;
    Ok(context)
}
