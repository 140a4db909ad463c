using Demos.Terminal;

return DemosCommand.Run(args);
