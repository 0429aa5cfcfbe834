//! A Ballista executor with polycsg's functions.
use ballista_core::error::Result;
use ballista_executor::executor_process::{ExecutorProcessConfig, start_executor_process};
use clap::Parser;
use std::net::IpAddr;
use std::path::PathBuf;
use std::sync::Arc;

/// A Ballista executor with polycsg's functions.
#[derive(Parser)]
struct ExecutorArguments {
    /// The address to listen on.
    #[arg(long, default_value = "127.0.0.1")]
    host: IpAddr,
    /// The port for shuffles; the next one is for the scheduler's calls.
    #[arg(long, default_value_t = 50051)]
    port: u16,
    /// The scheduler's host.
    #[arg(long, default_value = "127.0.0.1")]
    scheduler_host: String,
    /// The scheduler's port.
    #[arg(long, default_value_t = 50050)]
    scheduler_port: u16,
    /// How many tasks run at once; the number of cores, if not given.
    #[arg(long)]
    tasks: Option<usize>,
    /// How many bytes all tasks together may take; most of the machine's memory, if not given.
    #[arg(long)]
    memory: Option<u64>,
    /// The folder for shuffles; a temporary one, if not given.
    #[arg(long)]
    work_dir: Option<PathBuf>,
    /// Seconds between heartbeats.
    #[arg(long, default_value_t = 2)]
    heartbeat: u64,
}

#[tokio::main]
async fn main() -> Result<()> {
    let arguments = ExecutorArguments::parse();
    env_logger::init_from_env(env_logger::Env::default().default_filter_or("info"));
    let defaults = ExecutorProcessConfig::default();
    let config = ExecutorProcessConfig {
        bind_host: arguments.host.to_string(),
        external_host: Some(arguments.host.to_string()),
        port: arguments.port,
        grpc_port: arguments.port + 1,
        scheduler_host: arguments.scheduler_host,
        scheduler_port: arguments.scheduler_port,
        scheduler_connect_timeout_seconds: 20,
        vcores: arguments.tasks.unwrap_or(defaults.vcores),
        memory_pool_size: arguments.memory,
        work_dir: arguments.work_dir.map(|path| path.to_string_lossy().into_owned()),
        executor_heartbeat_interval_seconds: arguments.heartbeat,
        override_execution_engine: Some(Arc::new(polycsg_ballista::BoxJoinEngine::default())),
        override_function_registry: Some(Arc::new(polycsg_ballista::executor_functions())),
        ..defaults
    };
    start_executor_process(Arc::new(config)).await
}
